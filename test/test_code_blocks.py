"""Every code block of the documents runs: Python as it stands, commands in their order.

A block marked `python` or `bash` is run, those of one page in one scratch folder. A block marked
`console` needs more than this package (make, ROS 2); its `truck-blowout` lines, like those of every
indented block, are held against the options that the verbs take.
"""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

import pytest
import typer.main

from truck_blowout_sim.cli.main import VERBS, build

ROOT = Path(__file__).resolve().parents[1]
DOCS = ROOT / "docs"
PAGES = sorted([ROOT / "README.md", *DOCS.rglob("*.md")])
BLOCK = re.compile(r"^```(python|bash)\n(.*?)^```", re.DOTALL | re.MULTILINE)
COMMAND = re.compile(r"^(?:    |)(?:\.venv/bin/)?truck-blowout (.+?)$", re.MULTILINE)
OPTION = re.compile(r"(?<!\S)(--?[a-z][\w-]*)")
NODES = ("simulator", "player")  # their options are ROS 2 parameters: test/nodes checks them
WITH_BLOCKS = [page for page in PAGES if BLOCK.search(page.read_text(encoding="utf-8"))]


def _environment() -> dict[str, str]:
    programs = Path(sys.executable).parent
    return {**os.environ, "PATH": f"{programs}:{os.environ['PATH']}"}


@pytest.mark.parametrize("page", WITH_BLOCKS, ids=lambda page: page.stem)
def test_the_blocks_of_a_page_run(page: Path, tmp_path: Path) -> None:
    for language, text in BLOCK.findall(page.read_text(encoding="utf-8")):
        if "rclpy" in text and find_spec("rclpy") is None:
            continue
        words = [sys.executable, "-c"] if language == "python" else ["bash", "-euc"]
        done = subprocess.run([*words, text], cwd=tmp_path, env=_environment(),
                              capture_output=True, text=True, check=False)  # fmt: skip
        assert done.returncode == 0, f"{text}\n{done.stdout}\n{done.stderr}"


@pytest.mark.parametrize("notebook", sorted((DOCS / "notebooks").glob("*.ipynb")),
                         ids=lambda path: path.stem)  # fmt: skip
def test_the_cells_of_a_notebook_run(notebook: Path, tmp_path: Path) -> None:
    cells = json.loads(notebook.read_text(encoding="utf-8"))["cells"]
    code = "\n".join("".join(cell["source"]) for cell in cells if cell["cell_type"] == "code")
    done = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, capture_output=True,
                          env={**_environment(), "MPLBACKEND": "Agg"}, text=True,
                          check=False)  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert all(cell["outputs"] for cell in cells if cell["cell_type"] == "code"), "not saved run"


def _options(verb: str) -> set[str]:
    command = typer.main.get_command(build([verb])).commands[verb]  # type: ignore[arg-type,attr-defined]
    words = {word for p in command.params for word in (*p.opts, *p.secondary_opts)}
    return words | {"--help", "--traceback", "--version"}


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_commands_on_a_page_name_verbs_and_options_that_exist(page: Path) -> None:
    wrong = []
    for line in COMMAND.findall(page.read_text(encoding="utf-8").replace("\\\n", " ")):
        verb = line.split()[0]
        if verb.isupper() or verb.startswith("-") or verb in NODES:
            continue
        unknown = {verb} - set(VERBS)
        if not unknown:
            unknown = set(OPTION.findall(line.split("--ros-args")[0])) - _options(verb)
        if unknown:
            wrong.append((line, unknown))
    assert not wrong
