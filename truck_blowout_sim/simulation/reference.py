"""The reference of all scenario keys, as Markdown, from the schema itself.

`python -m truck_blowout_sim.simulation.reference docs/scenario_files.md` brings that page up to
date; without a file it prints. A test holds the page against the schema.
"""

from __future__ import annotations

import sys
from pathlib import Path

from truck_blowout_sim.simulation.scenario_schema import ScenarioSpec
from truck_blowout_sim.vehicle.reference import key_block, key_line

TITLE = "## All keys"


def reference_markdown() -> str:
    """Every key of a scenario file."""
    last = ["values:", key_line("  <name>", "number, optional: a vehicle parameter, packed name")]
    return "\n".join([TITLE, "", *key_block(ScenarioSpec, last)]) + "\n"


def write_into(page: Path) -> None:
    """Replace the reference at the end of a page by the present one."""
    words, _, _ = page.read_text(encoding="utf-8").partition(TITLE)
    page.write_text(words + reference_markdown(), encoding="utf-8")


if __name__ == "__main__":
    for name in sys.argv[1:]:
        write_into(Path(name))
    if not sys.argv[1:]:
        sys.stdout.write(reference_markdown())
