"""One page on many runs: what each varied key does to lane, hand wheel, articulation, rollover.

Validated with: test/simulation/test_sweep.py.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.recordings.atomic import replacing_all
from truck_blowout_sim.report.page import render, write_pictures, write_text
from truck_blowout_sim.report.style import Picture
from truck_blowout_sim.report.sweep_figures import outcome_picture, pair_picture, share_picture
from truck_blowout_sim.simulation.studies import Batch
from truck_blowout_sim.simulation.studies.influence import groups, share_explained

Floats = NDArray[np.float64]
PAGE, FIGURES = "report.html", "figures"
_FAILED = "failed"
_WORST, _REASONS = 10, 12


@dataclass(frozen=True)
class Outcome:
    """A measure as the page shows it.

    Attributes:
        name: of the measure; ``title``: in words; ``unit``, ``factor``: as shown.
        rate: a share of runs, not a size.
    """

    name: str
    title: str
    unit: str
    factor: float = 1.0
    rate: bool = False


OUTCOMES = (
    Outcome("lane_departure_m", "Lane departure", "m"),
    Outcome("sideways_m", "Sideways movement", "m"),
    Outcome("left_lane", "Runs in which a tire leaves the lane, after a burst if there is one",
            "%", 100.0, rate=True),
    Outcome("peak_hand_wheel_rad", "Hand wheel turned by", "deg", 180.0 / np.pi),
    Outcome("peak_articulation_rad", "Articulation", "deg", 180.0 / np.pi),
    Outcome("peak_load_transfer", "Load transfer", "%", 100.0),
    Outcome("rolled_over", "Runs in which a unit rolls over", "%", 100.0, rate=True),
)


@dataclass(frozen=True, eq=False)
class Findings:
    """What the page shows.

    Attributes:
        keys: what varied; ``labels``, ``at``: its values, and which each run that did not fail has.
        outcomes: value of each outcome in those runs, as shown.
        shares: share of an outcome's variance that each key explains, by outcome and key.
        counts: runs by status; ``reasons``: failures by reason, most frequent first.
    """

    keys: tuple[str, ...]
    labels: Mapping[str, list[str]]
    at: Mapping[str, NDArray[np.int64]]
    outcomes: Mapping[str, Floats]
    shares: Mapping[str, Mapping[str, float]]
    counts: Mapping[str, int]
    reasons: Sequence[tuple[str, int]]


def findings(batch: Batch, keys: Sequence[str]) -> Findings:
    """Outcomes of the runs, key by key."""
    status = batch.column("status")
    good = np.array([s != _FAILED for s in status])
    outcomes = {o.name: o.factor * _values(batch, o.name)[good] for o in OUTCOMES}
    labels, at = {}, {}
    for key in keys:
        column = [v for v, ok in zip(batch.column(key), good, strict=True) if ok]
        labels[key], at[key] = groups(column)
    shares = {name: {key: share_explained(at[key], values) for key in keys}
              for name, values in outcomes.items()}
    reasons = Counter(r for r in batch.column("reason") if r)
    return Findings(tuple(keys), labels, at, outcomes, shares, dict(Counter(status)),
                    reasons.most_common(_REASONS))


def sentences(found: Findings) -> list[str]:
    """One sentence per outcome."""
    said = []
    for outcome in OUTCOMES:
        values, shares = found.outcomes[outcome.name], found.shares[outcome.name]
        if not values.size:
            continue
        low, high = float(values.min()), float(values.max())
        if outcome.rate:
            start = f"{outcome.title}: {values.mean():.0f} %"
        else:
            start = (f"{outcome.title}: median {np.median(values):.3g} {outcome.unit}, "
                     f"range {low:.3g} to {high:.3g} {outcome.unit}")
        ranked = sorted(shares.items(), key=lambda item: -item[1])
        parts = [f"{key} explains {100.0 * share:.0f} % of the variance"
                 for key, share in ranked[:2] if share >= 0.05]
        said.append(start + (f"; {', '.join(parts)}" if parts else "") + ".")
    return said


def headline(found: Findings) -> str:
    """How the runs ended, in one line."""
    total = sum(found.counts.values())
    others = [f"{n} {status}" for status, n in sorted(found.counts.items()) if status != "ok"]
    left = found.outcomes["left_lane"]
    lane = f"; a tire left the lane in {left.mean():.0f} % of them" if left.size else ""
    runs = "1 run" if total == 1 else f"{total} runs"
    return runs + (f", {', '.join(others)}" if others else ", none failed") + lane


def pictures(found: Findings) -> tuple[Picture, ...]:
    """A figure for each outcome that differs, what explains them, and the two strongest keys."""
    drawn = [share_picture(found.keys, {o.title: found.shares[o.name] for o in OUTCOMES
                                        if np.ptp(found.outcomes[o.name]) > 0.0})
             ] if found.outcomes["left_lane"].size else []
    for o in OUTCOMES:
        values = found.outcomes[o.name]
        if values.size and np.ptp(values) > 0.0:
            drawn.append(outcome_picture(o.name, f"{o.title} ({o.unit})", values, found.labels,
                                         found.at, rate=o.rate))
            ranked = sorted(found.keys, key=lambda key: -found.shares[o.name][key])
            if len(ranked) > 1 and o.name in ("left_lane", "rolled_over", "peak_load_transfer"):
                a, b = ranked[:2]
                drawn.append(pair_picture(f"{o.name}_pair", f"{o.title} ({o.unit})", values, (a, b),
                                          found.labels, found.at))
    return tuple(drawn)


def write_sweep_report(batch: Batch, keys: Sequence[str], title: str, command: str, folder: Path
                       ) -> tuple[Path, Findings]:
    """Write the page and its figures.

    Args:
        title: of the scenario; ``command``: that repeats the sweep.

    Raises:
        StorageError: a file cannot be written; then none is.
    """
    found = findings(batch, keys)
    drawn = pictures(found)
    page = render("sweep.html", {
        "title": title, "headline": headline(found), "sentences": sentences(found),
        "command": command, "pictures": drawn, "keys": keys, "worst": _worst(batch, keys),
        "reasons": found.reasons,
        "columns": [f"{o.title} ({o.unit})" for o in OUTCOMES if not o.rate],
    })
    with replacing_all(folder) as temporary:
        write_pictures(drawn, temporary / FIGURES)
        write_text(page, temporary / PAGE)
    return folder / PAGE, found


def _worst(batch: Batch, keys: Sequence[str]) -> list[list[str]]:
    """The most severe runs: rolled over first, then by load transfer."""
    transfer = _values(batch, "peak_load_transfer")
    over = _values(batch, "rolled_over")
    order = [k for k in np.lexsort((-np.nan_to_num(transfer), -np.nan_to_num(over)))
             if np.isfinite(transfer[k])][:_WORST]
    shown: dict[str, list[Any]] = {key: batch.column(key) for key in (*keys, "run", "status")}
    sizes = {o.name: o.factor * _values(batch, o.name) for o in OUTCOMES if not o.rate}
    return [[str(shown["run"][k]), *(_text(shown[key][k]) for key in keys), shown["status"][k],
             *(f"{values[k]:.3g}" for values in sizes.values())] for k in order]


def _values(batch: Batch, name: str) -> Floats:
    """A measure as numbers; NaN where a run failed. Whether the lane was left comes from when.

    A truck that had left it before the first tire burst says nothing about the burst.
    """
    if name == "left_lane":
        when = (batch.column(key) for key in ("status", "left_lane_s", "blown_s"))
        return np.array([np.nan if status == _FAILED else _left(left_s, blown_s)
                         for status, left_s, blown_s in zip(*when, strict=True)])
    return np.array([np.nan if v is None else float(v) for v in batch.column(name)])


def _left(left_s: float | None, blown_s: float | None) -> float:
    return float(left_s is not None and (blown_s is None or left_s >= blown_s))


def _text(value: object) -> str:
    return f"{value:g}" if isinstance(value, float) else str(value)
