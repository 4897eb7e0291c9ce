"""Effect by effect: how often each was found, how visible it was, what it was taken for.

Cases with one cause only. A listed effect is found when its name is in the first alias set, one of
no list when the verdict is ``unknown``.

Validated with: test/proof/test_by_effect.py.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from typing import Any

from truck_blowout_sim.proof.score import CaseScore, CauseScore
from truck_blowout_sim.proof.statistics import Proportion, proportion

SIGMA_EDGES = (0.0, 7.0, 14.0, 28.0, 64.0, float("inf"))
Row = dict[str, Any]


def effect_rows(scores: Sequence[CaseScore]) -> list[Row]:
    """One row for each concealed effect: physics, instruments, what is in no list or not now."""
    alone = [s for s in scores if len(s.causes) == 1]
    names = {(s.causes[0].name, s.causes[0].kind) for s in alone}
    order = ("physics", "sensor", "unlisted", "taken_out")
    return [_row(name, kind, [s for s in alone if (s.causes[0].name, s.causes[0].kind)
                              == (name, kind)])
            for name, kind in sorted(names, key=lambda item: (order.index(item[1]), item))]


def _row(name: str, kind: str, scores: Sequence[CaseScore]) -> Row:
    wrong = Counter(taken_for(s) for s in scores if not found(s))
    return {"name": name, "kind": kind, "found": proportion(map(found, scores)).as_json(),
            "by_sigma": [proportion(found(s) for s in scores if _within(s, k)).as_json()
                         for k in range(len(SIGMA_EDGES) - 1)],
            "taken_for": dict(wrong.most_common())}


def _within(score: CaseScore, k: int) -> bool:
    return score.sigma is not None and SIGMA_EDGES[k] <= score.sigma < SIGMA_EDGES[k + 1]


def found(score: CaseScore) -> bool:
    """Whether the one cause of a case was found."""
    return cause_found(score, score.causes[0])


def cause_found(score: CaseScore, cause: CauseScore) -> bool:
    """Whether a cause of a case was found."""
    return score.verdict == "unknown" if score.group == "unknown" else cause.aliased


def taken_for(score: CaseScore) -> str:
    """The first name given, else what the verdict says without one."""
    if score.named:
        return score.named[0]
    return "unknown" if score.detected else "nothing"


def effect_table(rows: Sequence[Mapping[str, Any]]) -> list[str]:
    """The rows as Markdown."""
    lines = ["Found of concealed, by sigma. Cases with one cause.", "",
             "| concealed | " + " | ".join(map(span, range(len(SIGMA_EDGES) - 1)))
             + " | all (95 % Wilson) | taken for, where not found |",
             "|---" * (len(SIGMA_EDGES) + 2) + "|"]
    for row in rows:
        cells = [f"{p['hits']}/{p['trials']}" if p["trials"] else "" for p in row["by_sigma"]]
        wrong = ", ".join(f"{name} {count}" for name, count in row["taken_for"].items())
        whole = Proportion(row["found"]["hits"], row["found"]["trials"])
        name = row["name"] + (", taken out" if row["kind"] == "taken_out" else "")
        lines.append(f"| {name} | {' | '.join(cells)} | {whole} | {wrong} |")
    return lines


def span(k: int) -> str:
    """A class of visibility in words."""
    low, high = SIGMA_EDGES[k], SIGMA_EDGES[k + 1]
    return f"{low:g}–{high:g}" if high < float("inf") else f"≥ {low:g}"
