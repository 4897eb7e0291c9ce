"""Cause by cause, over several worlds: how many were found, and what was stated in their place.

A listed effect is found when it is in an alias set, one of no list when the verdict is
``unknown``. Effects count that stand out of what fault-free vehicles differ by (six spreads);
instruments' faults count all, as nothing is known of their spread.

Validated with: test/proof/test_causes.py.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from truck_blowout_sim.proof.by_effect import cause_found
from truck_blowout_sim.proof.cases import Cause, Truth
from truck_blowout_sim.proof.rows import VISIBLE, wrong_names
from truck_blowout_sim.proof.score import CaseScore
from truck_blowout_sim.proof.statistics import proportion

KIND_WORDS: Mapping[str, str] = {"physics": "", "sensor": " (instrument)",
                                 "taken_out": " (taken out of the library)",
                                 "unlisted": " (of no list)"}  # fmt: skip
ORDER = tuple(KIND_WORDS)
Entry = dict[str, Any]


def causes_told(scores: Sequence[CaseScore], truths: Mapping[str, Truth]) -> list[Entry]:
    """One plain object a concealed cause that stands out: case, name, kind, whether found."""
    return [{"case": score.case, "name": cause.name, "kind": cause.kind,
             "found": cause_found(score, told)}
            for score in scores
            for told, cause in zip(score.causes, truths[score.case].causes, strict=True)
            if _stands_out(cause)]


def _stands_out(cause: Cause) -> bool:
    return cause.kind == "sensor" or (cause.visibility or 0.0) >= VISIBLE


def wrongly_told(scores: Sequence[CaseScore], truths: Mapping[str, Truth]) -> list[Entry]:
    """One plain object a case with a wrong name: what was concealed, what was stated wrongly."""
    stated = [(score, wrong_names(score, truths[score.case])) for score in scores]
    return [{"case": score.case, **_concealed(truths[score.case]), "stated": names}
            for score, names in stated if names]


def _concealed(truth: Truth) -> Entry:
    """Kind and name of the one cause; without a kind where there is none, or more than one."""
    if len(truth.causes) == 1:
        return {"kind": truth.causes[0].kind, "concealed": truth.causes[0].name}
    return {"kind": "", "concealed": "two effects" if truth.causes else "nothing"}


def causes_table(figures: Mapping[str, Mapping[str, Any]]) -> str:
    """A Markdown row a cause: found of concealed in each world, wrong names in all of them.

    Args:
        figures: of ``proof.json``, by world.
    """
    told = {world: one["causes"] for world, one in figures.items()}
    wrong = [entry for one in figures.values() for entry in one["wrongly_told"]]
    keys = {(e["kind"], e["name"]) for every in told.values() for e in every}
    keys |= {(e["kind"], e["concealed"]) for e in wrong}
    lines = ["| concealed | " + " | ".join(w.upper() for w in told) + " | wrong names stated |",
             "|---" * (len(told) + 2) + "|"]
    for kind, name in sorted(keys, key=_place):
        cells = [_found(e["found"] for e in every if (e["kind"], e["name"]) == (kind, name))
                 for every in told.values()]
        stated = Counter(one for e in wrong if (e["kind"], e["concealed"]) == (kind, name)
                         for one in e["stated"])
        words = ", ".join(one if count == 1 else f"{one} {count}"
                          for one, count in stated.most_common())
        lines.append(f"| {name}{KIND_WORDS.get(kind, '')} | {' | '.join(cells)} | {words} |")
    return "\n".join(lines)


def _place(key: tuple[str, str]) -> tuple[int, str]:
    return (ORDER.index(key[0]) if key[0] in ORDER else len(ORDER), key[1])


def _found(flags: Iterable[bool]) -> str:
    count = proportion(flags)
    return f"{count.hits}/{count.trials}" if count.trials else ""
