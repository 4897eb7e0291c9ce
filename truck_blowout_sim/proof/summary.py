"""Count over all cases: every proportion with its interval, every failure kept.

Validated with: test/proof/test_summary.py.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from typing import Any

import numpy as np
from scipy.stats import norm

from truck_blowout_sim.proof.by_effect import SIGMA_EDGES, effect_rows
from truck_blowout_sim.proof.comparable import NOT_COMPARABLE, ParameterScore
from truck_blowout_sim.proof.score import ABRUPT, CaseScore, CauseScore
from truck_blowout_sim.proof.statistics import Proportion, proportion, quantile

STRONG_SIGMA = 10.0
P_LEVELS = (0.01, 0.05, 0.1, 0.5)
INTERVAL_LEVELS = (0.5, 0.7, 0.8, 0.9, 0.95, 0.99)
COMPARED = ("single", "pair", "unknown")  # groups of cases with physics missing
RIVALS = ("no_change", "recalibrated", "gaussian_process", "sparse_regression", "diagnosed")
Figures = dict[str, Any]


def null_floor(lines: Mapping[str, Mapping[str, Any]], nulls: Sequence[str]) -> dict[str, float]:
    """Median over null cases of the mean square left in each channel on holdout."""
    left: dict[str, list[float]] = {}
    for case in nulls:
        answer = lines[case]["answer"]
        for name, rms in (answer["fit"]["holdout"]["after"] if answer else {}).items():
            left.setdefault(name, []).append(rms**2)
    return {name: float(np.median(values)) for name, values in left.items()}


def confusion(scores: Sequence[CaseScore]) -> dict[str, Counter[str]]:
    """Verdicts given, by group of case."""
    table: dict[str, Counter[str]] = {}
    for score in scores:
        table.setdefault(score.group, Counter())[score.verdict] += 1
    return table


def solved(scores: Sequence[CaseScore], failed_groups: Sequence[str]) -> dict[str, Proportion]:
    """By group: verdict right, and every listed effect in an alias set; breaking down is wrong."""
    known = [(s.group, s.solved) for s in scores] + [(group, False) for group in failed_groups]
    groups = dict.fromkeys(group for group, _ in known)
    return {group: proportion(ok for g, ok in known if g == group) for group in groups}


def naming(scores: Sequence[CaseScore]) -> dict[str, Proportion]:
    """Names given to single physical effects and instrument faults of at least 10 sigma."""
    strong = [s for s in scores if s.group in ("single", "sensor") and len(s.causes) == 1
              and (s.causes[0].sigma or 0.0) >= STRONG_SIGMA]
    single = [s for s in strong if s.group == "single"]
    return {
        "effect named at alias-set level": proportion(s.causes[0].aliased for s in single),
        "effect named first, raw": proportion(s.causes[0].raw for s in single),
        "instrument fault named at alias-set level": proportion(
            s.causes[0].aliased for s in strong if s.group == "sensor"),
        "truth inside the alias set, where something was named": proportion(
            s.causes[0].aliased for s in single if s.named),
        "nothing named beside the one effect": proportion(
            len(s.named) == 1 for s in single if s.named),
    }


def verdicts(scores: Sequence[CaseScore]) -> dict[str, Proportion]:
    """Alarms on nulls, unknowns, sensor against physics, pairs."""
    nulls = [s for s in scores if s.group == "null"]
    unknown = [s for s in scores if s.group == "unknown"]
    pairs = [s for s in scores if s.group == "pair"]
    return {
        "verdict right, all cases": proportion(s.right for s in scores),
        "false discovery on nulls": proportion(s.detected for s in nulls),
        "unknown recognised": proportion(s.verdict == "unknown" for s in unknown),
        "unknown misnamed": proportion(
            s.verdict in ("missing_physics", "sensor_artefact") for s in unknown),
        "unknown not noticed": proportion(not s.detected for s in unknown),
        "sensor against physics": proportion(s.kind_right for s in scores),
        "both of a pair, alias-set level": proportion(
            all(c.aliased for c in s.causes) for s in pairs),
        "one of a pair at least": proportion(any(c.aliased for c in s.causes) for s in pairs),
    }


def places(scores: Sequence[CaseScore]) -> dict[str, Proportion]:
    """Body and axle, of effects whose raw name is right and for which both sides state one."""
    rows = [(s, c) for s in scores for c in s.causes]
    return {
        "body": proportion(c.body for _, c in rows),
        "axle, wheel channels present": proportion(c.axle for s, c in rows if s.wheel_channels),
    }


def onsets(causes: Sequence[CauseScore]) -> Figures:
    """Absolute onset errors of abrupt effects and of all timed ones."""
    def figures(chosen: Sequence[CauseScore]) -> Figures:
        errors = [c.onset_error_s for c in chosen if c.onset_error_s is not None]
        return {"count": len(errors), "median_s": quantile(errors, 0.5),
                "p90_s": quantile(errors, 0.9),
                "coverage": proportion(c.onset_covered for c in chosen).as_json()}
    return {"abrupt": figures([c for c in causes if c.name in ABRUPT]), "all": figures(causes)}


def parameters(scored: Sequence[ParameterScore]) -> Figures:
    """Relative errors and coverage of the 90 % intervals, where the quantities are the same."""
    return {"count": len(scored),
            "median_relative_error": quantile([p.relative_error for p in scored], 0.5),
            "coverage": proportion(p.covered for p in scored).as_json(),
            "intervals": [{"stated": level, **held(scored, level).as_json()}
                          for level in INTERVAL_LEVELS],
            "each": [asdict(p) for p in scored], "not_comparable": dict(NOT_COMPARABLE)}


def held(scored: Sequence[ParameterScore], level: float) -> Proportion:
    """Share of intervals of a level that hold the truth; the stated 90 % ones, normal, resized."""
    reach = float(norm.ppf(0.5 + 0.5 * level) / norm.ppf(0.95))
    return proportion(None if p.arms is None else p.arms <= reach for p in scored)


def power(scores: Sequence[CaseScore]) -> list[Figures]:
    """By visibility: share noticed, named at alias-set level, named first; single effects."""
    rows = []
    singles = [s for s in scores if s.group == "single" and s.sigma is not None]
    for k, low in enumerate(SIGMA_EDGES[:-1]):
        high = SIGMA_EDGES[k + 1]
        chosen = [s for s in singles if s.sigma is not None and low <= s.sigma < high]
        rows.append({"sigma": [low, high if np.isfinite(high) else None],
                     "noticed": proportion(s.detected for s in chosen),
                     "aliased": proportion(s.causes[0].aliased for s in chosen),
                     "raw": proportion(s.causes[0].raw for s in chosen)})
    return rows


def improvement(scores: Sequence[CaseScore]) -> Figures:
    """Holdout fit of cases in which physics is missing."""
    fits = [s.holdout for s in scores if s.group in ("single", "pair") and s.holdout]
    excess = [r for f in fits if (r := f.removed(1.0)) is not None]
    floored = [r for f in fits if f.floor is not None
               and (r := f.removed(max(f.floor, 1.0))) is not None]
    return {
        "improved": proportion(f.after < f.before for f in fits).as_json(),
        "median_removed_of_excess_over_instruments": quantile(excess, 0.5),
        "count_over_instruments": len(excess),
        "median_removed_of_excess_over_null_floor": quantile(floored, 0.5),
        "count_over_null_floor": len(floored),
    }


def rivals(scores: Sequence[CaseScore]) -> Figures:
    """Median holdout error of each rival, and how often the diagnosed model beats it."""
    rows = [s.baselines for s in scores
            if s.group in COMPARED and set(RIVALS) <= set(s.baselines)]
    return {name: {
        "count": len(rows),
        "median_mean_square": quantile([row[name] for row in rows], 0.5),
        "diagnosed_is_better": proportion(
            None if name == "diagnosed" else row["diagnosed"] < row[name] for row in rows
        ).as_json()} for name in RIVALS}


def null_p_values(scores: Sequence[CaseScore]) -> list[float]:
    """Sorted p-values of null cases: uniform if they mean what they say."""
    return sorted(s.p_value for s in scores if s.group == "null" and s.p_value is not None)


def summarize(scores: Sequence[CaseScore], failed: Mapping[str, str],
              failed_groups: Sequence[str] = ()) -> Figures:
    """All figures as plain objects; ``failed``: why, by case, and of which groups these are."""
    causes = [c for s in scores for c in s.causes]
    sizes = [c.alias_size for s in scores if s.group == "single" for c in s.causes
             if c.alias_size is not None]
    rows = {**naming(scores), **verdicts(scores), **places(scores)}
    return {
        "cases": len(scores), "failed": dict(failed),
        "confusion": {group: dict(counts) for group, counts in confusion(scores).items()},
        "solved": {group: p.as_json() for group, p in solved(scores, failed_groups).items()},
        "proportions": {name: p.as_json() for name, p in rows.items()},
        "mean_alias_set_size": float(np.mean(sizes)) if sizes else None,
        "onset": onsets(causes),
        "parameters": parameters([c.parameter for c in causes if c.parameter]),
        "power": [{k: v.as_json() if isinstance(v, Proportion) else v for k, v in row.items()}
                  for row in power(scores)],
        "effects": effect_rows(scores),
        "holdout": improvement(scores), "rivals": rivals(scores),
        "null_p_values": null_p_values(scores),
        "null_p_values_at_most": {
            str(level): proportion(p <= level for p in null_p_values(scores)).as_json()
            for level in P_LEVELS},
        "cpu_s": {"median": quantile([s.cpu_s for s in scores], 0.5),
                  "total": float(sum(s.cpu_s for s in scores))},
    }
