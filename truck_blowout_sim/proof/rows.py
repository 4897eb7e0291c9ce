"""What must hold in every world, row by row, with Wilson intervals.

An effect counts where an ideal detector sees it: sigma_b of at least 6, from ``sigma_b.json``
beside the cases (`python -m proving_ground sigma`); without that file every effect counts. What
fault-free vehicles differ by in the effect's own number is included: on a road that banks by no
more than roads do, nothing is missing. One row leaves that out. Two rows count what is as visible
beside what imitates it best (`python -m proving_ground apart`). An interval of an amount holds the
truth on a side that is open; an interval of an onset that is open is not counted.

Validated with: test/proof/test_rows.py.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from scipy.stats import kstest

from truck_blowout_sim.proof.cases import Truth
from truck_blowout_sim.proof.score import CaseScore
from truck_blowout_sim.proof.statistics import Proportion, proportion

VISIBLE = 6.0
Row = tuple[str, Proportion]


def rows(scores: Sequence[CaseScore], truths: Mapping[str, Truth]) -> list[Row]:
    """The rows of one world, in order."""
    missing = [s for s in scores if s.group != "null"]
    physics = [s for s in scores if s.group in ("single", "pair")]

    def of(group: str) -> list[CaseScore]:
        return [s for s in scores if s.group == group]

    def share(chosen: Sequence[CaseScore], holds: Callable[[CaseScore], bool | None]
              ) -> Proportion:
        return proportion(map(holds, chosen))

    causes = [(c, t) for s in physics for c, t in zip(s.causes, truths[s.case].causes, strict=True)]
    visible = [c.aliased for c, t in causes if t.kind == "physics"
               and t.measured and (t.sigma_b is None or t.sigma_b >= VISIBLE)]
    beyond = [c.aliased for c, t in causes if t.kind == "physics"
              and t.beyond_spread is not None and t.beyond_spread >= VISIBLE]
    intervals = [c.parameter.covered for s in scores for c in s.causes if c.parameter]
    onsets = [c.onset_covered for s in scores for c in s.causes]

    def stands_out(score: CaseScore) -> bool:
        return strongest(truths[score.case]) >= VISIBLE

    return [
        ("false alarms, nothing missing", share(of("null"), lambda s: s.detected)),
        ("effects seen by an ideal detector, among the causes named", proportion(visible)),
        ("effects beyond six spreads of fault-free vehicles, among the causes named",
         proportion(beyond)),
        ("a wrong name stated, something missing",
         share(missing, lambda s: bool(wrong_names(s, truths[s.case])))),
        ("of no list: unknown",
         share([s for s in of("unknown") if all_seen(truths[s.case])], said_unknown)),
        ("of no list, and no listed effect imitates it: unknown",
         share([s for s in of("unknown") if none_imitated(truths[s.case])], said_unknown)),
        ("both of a pair",
         share([s for s in of("pair") if all_seen(truths[s.case])], all_told)),
        ("both of a pair, neither imitates the other",
         share([s for s in of("pair") if none_imitated(truths[s.case])], all_told)),
        ("instrument told from truck", share(missing, lambda s: s.kind_right)),
        ("instrument fault named", share(of("sensor"), all_told)),
        ("90 % intervals of amounts hold the truth", proportion(intervals)),
        ("90 % intervals of onsets hold the truth", proportion(onsets)),
        ("one effect: truth in the alias set, where something was named",
         share([s for s in scores if s.group == "single" and s.named],
               lambda s: s.causes[0].aliased)),
        ("holdout better", share(physics, better)),
        ("holdout better, where physics was named",
         share([s for s in physics if s.verdict == "missing_physics" and s.named], better)),
        ("holdout better, an effect beyond six spreads",
         share([s for s in physics if stands_out(s)], better)),
        ("cases with physics missing that have an effect beyond six spreads",
         share(physics, stands_out)),
        ("p-value of 0.1 or less, nothing missing",
         share(of("null"), lambda s: None if s.p_value is None else s.p_value <= 0.1)),
    ]


def all_told(score: CaseScore) -> bool:
    """Whether every cause is in an alias set."""
    return all(c.aliased for c in score.causes)


def said_unknown(score: CaseScore) -> bool:
    """Whether the verdict is ``unknown``."""
    return score.verdict == "unknown"


def all_seen(truth: Truth) -> bool:
    """Whether every cause is visible, or nothing is known of how visible it is."""
    return all(c.visibility is None or c.visibility >= VISIBLE for c in truth.causes)


def none_imitated(truth: Truth) -> bool:
    """Whether every cause is visible, and as visible beside what imitates it best."""
    return all_seen(truth) and all(c.apart is not None and c.apart >= VISIBLE for c in truth.causes)


def better(score: CaseScore) -> bool | None:
    """Whether what was named lowers the error on unseen runs; None without any."""
    return score.holdout.after < score.holdout.before if score.holdout else None


def strongest(truth: Truth) -> float:
    """Visibility of the effect that is seen best, the spread of fault-free vehicles included."""
    return max((c.beyond_spread or 0.0 for c in truth.causes), default=0.0)


def wrong_names(score: CaseScore, truth: Truth) -> list[str]:
    """Names stated whose alias set holds no true cause."""
    true = {cause.name for cause in truth.causes if cause.kind in ("physics", "sensor")}
    return [name for name, aliases in zip(score.named, score.aliases, strict=True)
            if not true & {name, *aliases}]


def uniformity(scores: Sequence[CaseScore]) -> float | None:
    """Probability of the nulls' p-values, were they uniform (Kolmogorov and Smirnov)."""
    values = [s.p_value for s in scores if s.group == "null" and s.p_value is not None]
    return float(kstest(values, "uniform").pvalue) if len(values) >= 5 else None


def rows_table(found: Sequence[Row], uniform: float | None) -> list[str]:
    """The rows as Markdown."""
    lines = ["| what must hold | reached (hits/cases; 95 % Wilson) |", "|---|---|"]
    lines += [f"| {name} | {count} |" for name, count in found]
    said = "–" if uniform is None else f"{uniform:.2g}"
    return [*lines, f"| p-values of nulls uniform (Kolmogorov-Smirnov) | {said} |"]


def as_json(found: Sequence[Row]) -> list[dict[str, Any]]:
    """Plain objects."""
    return [{"row": name, **count.as_json()} for name, count in found]
