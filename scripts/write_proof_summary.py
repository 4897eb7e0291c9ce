"""Put the proof's tables into README.md and docs/proof.md, its picture and cases into docs/.

Use: python scripts/write_proof_summary.py w1=FOLDER w2=FOLDER ...

Each folder is what `truck-blowout prove -o FOLDER` wrote for the sealed cases of a world. The
picture is drawn anew where sigma_b was measured in every world, the table of rivals where they were
tried in any; else those of an earlier draw stay.
"""

from __future__ import annotations

import json
import shutil
import sys
from pathlib import Path

from truck_blowout_sim.proof.worlds import draw_power_by_world, rivals_table, worlds_table
from truck_blowout_sim.report.marked import put_on_page

ROOT = Path(__file__).resolve().parents[1]
PICTURE = "proof_power.png"
CAPTION = "Share of concealed effects that were named, against what an ideal detector sees"


def main(words: list[str]) -> int:
    runs = {world: Path(folder) for world, _, folder in (word.partition("=") for word in words)}
    if not runs or not all((folder / "proof.json").is_file() for folder in runs.values()):
        print(__doc__, file=sys.stderr)
        return 2
    figures = {world: json.loads((folder / "proof.json").read_text(encoding="utf-8"))
               for world, folder in runs.items()}  # fmt: skip
    for world, folder in runs.items():
        shutil.copy(folder / "cases.csv", ROOT / "docs" / f"proof_{world}_cases.csv")
    measured = all(one["seen"] for one in figures.values())
    if measured:
        (ROOT / "docs" / PICTURE).write_bytes(draw_power_by_world(figures).png())
    caption = CAPTION if measured else f"{CAPTION} (an earlier draw)"
    table = worlds_table(figures)
    for page, picture in (("README.md", f"docs/{PICTURE}"), ("docs/proof.md", PICTURE)):
        put_on_page(ROOT / page, "proof", f"{table}\n\n![{caption}]({picture})")
    if rivals := rivals_table(figures):
        put_on_page(ROOT / "docs/proof.md", "rivals", rivals)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
