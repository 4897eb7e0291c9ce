"""The linters as tests; what they check and why it is switched on or off is in pyproject.toml."""

from __future__ import annotations

import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]


def complaints(*words: str) -> str:
    """What a linter says where it fails, with its exit status; nothing where all is well."""
    # Always there under `make test`; a ROS build farm installs no linters.
    if find_spec(words[0]) is None:
        pytest.skip(f"{words[0]} is not installed")
    done = subprocess.run(
        [sys.executable, "-m", *words], cwd=ROOT, capture_output=True, text=True, check=False
    )
    return f"status {done.returncode}\n{done.stdout}{done.stderr}" if done.returncode else ""


def test_ruff_finds_nothing() -> None:
    assert complaints("ruff", "check", "--no-cache", "--quiet", ".") == ""


def test_types_hold() -> None:
    assert complaints("mypy", "--no-error-summary") == ""


def test_a_program_that_uses_the_library_is_typed() -> None:
    """`mypy --strict` on a user's program: the public names carry their types across."""
    assert complaints(
        "mypy", "--strict", "--no-warn-return-any", "--no-error-summary",
        "test/typed_user_program.py",
    ) == ""
