"""Count the published answers, and put the proof's tables into README.md and docs/proof*.md.

Use: python scripts/write_proof_summary.py [FOLDER for all figures, out/published]

Read are docs/proof_<world>_answers.jsonl.xz, docs/proof_<world>_again.jsonl.xz for what later code
answered to the same cases, and docs/proof_<world>_later.jsonl.xz for the draw sealed for that code.
Written are the tables, the picture, and the cases as docs/proof_<world>_cases.csv.
The picture is drawn anew where sigma_b was measured in every world,
the table of rivals where they were tried in any; else those of an earlier draw stay.
"""

from __future__ import annotations

import shutil
import sys
from pathlib import Path

from proving_ground.worlds import WORLDS
from truck_blowout_sim.errors import InputError
from truck_blowout_sim.proof.archive import read_entries, score_entries
from truck_blowout_sim.proof.causes import causes_table
from truck_blowout_sim.proof.places import Places
from truck_blowout_sim.proof.prove import Figures
from truck_blowout_sim.proof.worlds import (
    answered_of,
    draw_power_by_world,
    rivals_table,
    sets_table,
    worlds_table,
)
from truck_blowout_sim.report.marked import put_on_page

ROOT = Path(__file__).resolve().parents[1]
PICTURE = "proof_power.png"
FROZEN, AGAIN, LATER = ("sealed, diagnosed once", "the same cases, corrected code",
                        "a later draw, sealed for the corrected code, diagnosed once")
CAPTION = "Share of concealed effects that were named, against what an ideal detector sees"


def counted(manifest: Path, answers: Path, out: Path) -> Figures:
    """Figures of some answers to one world's cases, all files of them in ``out``."""
    return score_entries(read_entries(answers), manifest, out, answers)


def main(words: list[str]) -> int:
    if len(words) > 1:
        print(__doc__, file=sys.stderr)
        return 2
    out = Path(words[0] if words else ROOT / "out" / "published")
    try:
        figures, again, later = {}, {}, {}
        for world in WORLDS:
            places = Places(ROOT, world)
            figures[world] = counted(places.manifest, places.answers, out / world)
            again[world] = counted(places.manifest, places.again, out / f"{world}_again")
            later[world] = counted(places.later_manifest, places.later, out / f"{world}_later")
            shutil.copy(out / world / "cases.csv", places.cases)
    except InputError as error:
        print(error, file=sys.stderr)
        return 2
    measured = all(one["seen"] for one in figures.values())
    if measured:
        (ROOT / "docs" / PICTURE).write_bytes(draw_power_by_world(figures).png())
    caption = CAPTION if measured else f"{CAPTION} (an earlier draw)"
    for page, picture in (("README.md", f"docs/{PICTURE}"), ("docs/proof.md", PICTURE)):
        table = worlds_table(figures, short=page == "README.md")
        put_on_page(ROOT / page, "proof", f"{table}\n\n![{caption}]({picture})")
    for name, found in (("again", again), ("later", later)):
        table = f"Cases: {answered_of(found)}.\n\n{worlds_table(found, short=True)}"
        put_on_page(ROOT / "docs/proof.md", name, table)
    put_on_page(ROOT / "docs/proof.md", "short",
                sets_table({FROZEN: figures, AGAIN: again, LATER: later}))
    put_on_page(ROOT / "docs/proof.md", "causes", causes_table(figures))
    if rivals := rivals_table(figures):
        put_on_page(ROOT / "docs/proof_studies.md", "rivals", rivals)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
