"""What the documents promise: their links lead somewhere, README's program runs."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from truck_blowout_sim.cli.main import VERBS

ROOT = Path(__file__).resolve().parents[1]
CLI = ROOT / "truck_blowout_sim/cli"
DOCUMENTS = sorted([*ROOT.glob("*.md"), *(ROOT / "docs").rglob("*.md")])
LINK = re.compile(r"\]\(([^)#\s]+)[^)]*\)")
PROGRAM = re.compile(r"```python\n(.*?)```", re.DOTALL)


@pytest.mark.parametrize("document", DOCUMENTS, ids=lambda path: path.name)
def test_links_lead_to_files(document: Path) -> None:
    links = LINK.findall(document.read_text(encoding="utf-8"))
    inside = [link for link in links if "://" not in link and not link.startswith("mailto:")]
    missing = [link for link in inside if not (document.parent / link).exists()]
    assert not missing


def test_the_readmes_program_runs(tmp_path: Path) -> None:
    programs = PROGRAM.findall((ROOT / "README.md").read_text(encoding="utf-8"))
    assert programs
    done = subprocess.run(
        [sys.executable, "-c", "\n".join(programs)],
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr


def test_the_readmes_parameters_are_the_nodes() -> None:
    pytest.importorskip("rclpy")
    from truck_blowout_sim.nodes.simulator_parameters import SPECS

    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    section = readme.split("### Parameters of the simulator")[1].split("\n## ")[0]
    rows = re.findall(r"^\| `(\w+)` \| (\S*) *\| (\S*) *\|", section, re.MULTILINE)
    defaults = {spec.name: (str(spec.default), spec.unit) for spec in SPECS}
    assert len(rows) >= 8
    assert {name: (default, unit) for name, default, unit in rows} == {
        name: defaults[name] for name, _, _ in rows
    }


def test_the_readmes_verbs_are_the_command_lines() -> None:
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    section = readme.split("## From a terminal")[1].split("Exit status")[0]
    verbs = re.findall(r"^\| `(\w+)", section, re.MULTILINE)
    present = [v for v, (module, _) in VERBS.items() if (CLI / f"{module}.py").is_file()]
    assert sorted(verbs) == sorted(present)
