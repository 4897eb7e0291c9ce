"""Add the answers of scored cases to the published ones, docs/proof_<world>_answers.jsonl.xz.

Use: python scripts/publish_answers.py w1=CASES,RUN w2=CASES,RUN ...
     python scripts/publish_answers.py later-w1=CASES,RUN ...
     python scripts/publish_answers.py again=RUN again=RUN ...

CASES is the folder of the cases, RUN what `truck-blowout prove -o RUN` wrote for them. Published
answers of cases that the world's manifest no longer names are of an earlier draw and go. The second
form does the same for the draw that was sealed for later code, docs/proof_<world>_later.jsonl.xz.
The third adds what later code answered to published cases, docs/proof_<world>_again.jsonl.xz.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from proving_ground.worlds import WORLDS
from truck_blowout_sim.errors import InputError
from truck_blowout_sim.proof.archive import (
    answered_again,
    entries_of,
    joined,
    read_entries,
    write_entries,
)
from truck_blowout_sim.proof.cases import find_cases
from truck_blowout_sim.proof.places import Places
from truck_blowout_sim.proof.run import RESULTS, read_lines

ROOT = Path(__file__).resolve().parents[1]
LATER = "later-"


def publish(name: str, cases: Path, run: Path) -> str:
    """Add one world's answers, of the draw that ``name`` says; what was done, in words."""
    places = Places(ROOT, name.removeprefix(LATER))
    manifest, path = ((places.later_manifest, places.later) if name.startswith(LATER)
                      else (places.manifest, places.answers))
    sealed = json.loads(manifest.read_text(encoding="utf-8"))["cases"]
    before = [entry for entry in (read_entries(path) if path.is_file() else ())
              if entry.case in sealed]
    further = [entry for entry in entries_of(find_cases(cases), read_lines(run / RESULTS))
               if entry.case in sealed]
    every = joined(before, further)
    write_entries(path, every)
    return f"{path.name}: {len(every)} of {len(sealed)} sealed cases"


def publish_again(runs: Sequence[Path]) -> str:
    """Add what runs answered to published cases, of all worlds; what was done, in words.

    Of a case that several runs have, the answer of the last one counts.
    """
    lines: dict[str, Any] = {}
    counts = []
    for run in runs:
        found = read_lines(run / RESULTS)
        lines |= found
        if not found:
            counts.append(f"{run}: no results")
    for world in WORLDS:
        places = Places(ROOT, world)
        further = answered_again(read_entries(places.answers), lines)
        if not further:
            continue
        before = read_entries(places.again) if places.again.is_file() else ()
        every = joined(before, further)
        write_entries(places.again, every)
        counts.append(f"{places.again.name}: {len(every)} cases")
    return ", ".join(counts) or "no published case"


def main(words: list[str]) -> int:
    try:
        again = []
        for word in words:
            name, _, folders = word.partition("=")
            if name == "again":
                again.append(Path(folders))
                continue
            cases, run = map(Path, folders.split(","))
            print(publish(name, cases, run))
        if again:
            print(publish_again(again))
    except (ValueError, OSError, InputError) as error:
        print(f"{error}\n{__doc__}", file=sys.stderr)
        return 2
    return 0 if words else 2


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
