"""The linters as tests; what they check and why it is switched on or off is in pyproject.toml."""

from __future__ import annotations

import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]


def run_tool(*words: str) -> None:
    # Always there under `make test`; a ROS build farm installs no linters.
    if find_spec(words[0]) is None:
        pytest.skip(f"{words[0]} is not installed")
    done = subprocess.run(
        [sys.executable, "-m", *words], cwd=ROOT, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr


def test_ruff_finds_nothing() -> None:
    run_tool("ruff", "check", "--no-cache", "--quiet", ".")


def test_types_hold() -> None:
    run_tool("mypy", "--no-error-summary")


def test_a_program_that_uses_the_library_is_typed() -> None:
    """`mypy --strict` on a user's program: the public names carry their types across."""
    run_tool(
        "mypy", "--strict", "--no-warn-return-any", "--no-error-summary",
        "test/typed_user_program.py",
    )
