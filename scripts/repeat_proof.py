"""Make a sample of the sealed cases anew, diagnose them, and compare with the published answers.

Use: python scripts/repeat_proof.py out/proof [cases of each world, 4 unless told] [processes, 2]

The sample are the first cases of each world's table in docs/. Answers that a later correction
changed are listed in docs/proof_changed.csv. Recordings repeat byte for byte on
one kind of processor only; on another the seals of recordings are told as broken, and an answer
close to its limit may differ.
"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

from rich.console import Console
from rich.table import Table

from proving_ground.worlds import FIRST_SEED, WORLDS
from truck_blowout_sim.errors import InputError
from truck_blowout_sim.proof.places import Places
from truck_blowout_sim.proof.published import Repeat, cases_in, repeats

ROOT = Path(__file__).resolve().parents[1]
CHANGED = ROOT / "docs" / "proof_changed.csv"


def numbers(world: str, count: int) -> list[int]:
    """The first published cases of a world, by number."""
    cases = cases_in(Places(ROOT, world).cases)
    return sorted(int(case.partition("-")[2]) - FIRST_SEED[world] for case in cases)[:count]


def spans(numbers: list[int]) -> list[tuple[int, int]]:
    """First number and length of each unbroken stretch."""
    starts = [one for one in numbers if one - 1 not in numbers]
    ends = [one for one in numbers if one + 1 not in numbers]
    return [(first, last - first + 1) for first, last in zip(starts, ends, strict=True)]


def repeat(world: str, out: Path, count: int, workers: int) -> list[Repeat]:
    """Cases of one world, made, diagnosed and compared."""
    cases, run = out / world / "cases", out / world / "run"
    for first, many in spans(numbers(world, count)):
        _call("proving_ground", "world", world, "-o", str(cases), "--first", str(first),
              "--count", str(many), "--cores", str(workers))  # fmt: skip
    _call("truck_blowout_sim", "prove", "--cases", str(cases), "-o", str(run), "--workers",
          str(workers), "--no-baselines", "--renew", "--manifest",
          str(Places(ROOT, world).manifest))  # fmt: skip
    return repeats(run / "cases.csv", Places(ROOT, world).cases, CHANGED)


def _call(module: str, *words: str) -> None:
    subprocess.run([sys.executable, "-m", module, *words], cwd=ROOT, check=True)


def main(words: list[str]) -> int:
    if not words or len(words) > 3 or not all(word.isdigit() for word in words[1:]):
        print(__doc__, file=sys.stderr)
        return 2
    count, workers = (int(words[k]) if len(words) > k else usual for k, usual in ((1, 4), (2, 2)))
    out = Path(words[0]).absolute()
    table = Table("case", "concealed", "published", "now", "", box=None)
    found: list[Repeat] = []
    for world in WORLDS:
        try:
            found += repeat(world, out, count, workers)
        except (subprocess.CalledProcessError, InputError, OSError) as error:
            print(f"{world}: {error}", file=sys.stderr)
            return 2
    for one in found:
        table.add_row(one.case, one.concealed, one.published, one.now,
                      "same" if one.same else f"corrected: {one.why}" if one.corrected
                      else "DIFFERS")  # fmt: skip
    Console().print(table)
    same, corrected = sum(one.same for one in found), sum(one.corrected for one in found)
    print(f"{same} of {len(found)} answers are those that were published"
          + (f", {corrected} as corrected since." if corrected else "."))
    return 0 if same + corrected == len(found) else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
