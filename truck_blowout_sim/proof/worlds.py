"""The proof over several worlds side by side: tables, and power against sigma_b.

Validated with: test/proof/test_worlds.py.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from truck_blowout_sim.proof.statistics import Proportion, clustered, proportion
from truck_blowout_sim.proof.table import RIVAL_WORDS, counted, number
from truck_blowout_sim.report.style import CYCLE, Picture, new_axes, styled

Figures = Mapping[str, Any]
Trials = list[tuple[str, bool]]
BINS = (2.0, 6.0, 12.0, 18.0, 24.0)  # of sigma_b; the last has no end
# sought in W1, W2, W3 and W4, by the words of `rows.py`
SOUGHT: Mapping[str, tuple[str, str, str, str]] = {
    "false alarms, nothing missing": ("≤ 2 %",) * 4,
    "effects beyond six spreads of fault-free vehicles, among the causes named":
        ("≥ 92 %", "≥ 88 %", "≥ 85 %", "≥ 80 %"),
    "a wrong name stated, something missing": ("≤ 3 %", "≤ 4 %", "≤ 5 %", "≤ 4 %"),
    "of no list: unknown": ("≥ 85 %", "≥ 80 %", "≥ 70 %", "≥ 60 %"),
    "both of a pair": ("≥ 75 %", "≥ 70 %", "", ""),
    "instrument told from truck": ("≥ 98 %", "≥ 97 %", "≥ 95 %", "≥ 93 %"),
    "90 % intervals of amounts hold the truth": ("85–95 %",) * 4,
    "90 % intervals of onsets hold the truth": ("85–95 %",) * 4,
    "holdout better": ("≥ 97 %", "≥ 95 %", "≥ 95 %", "≥ 90 %"),
}
_UNIFORM = "p-values of nulls uniform (Kolmogorov-Smirnov)"
_TIME = "CPU time of an answer, median"


def worlds_table(figures: Mapping[str, Figures], short: bool = False) -> str:
    """What was sought and reached in each world, a Markdown row each.

    Args:
        figures: of ``proof.json``, by world (``w1`` to ``w4``).
        short: only rows in which something is sought. Others are left out where nothing counts.
    """
    names = list(figures)
    reached = {world: {row["row"]: row for row in one["rows"]} for world, one in figures.items()}
    lines = ["| | " + " | ".join(f"{w.upper()} sought | reached" for w in names) + " | all |",
             "|---" * (2 + 2 * len(names)) + "|"]
    for row in next(iter(reached.values()), {}):
        if short and row not in SOUGHT:
            continue
        entries = [reached[world].get(row, {"hits": 0, "trials": 0}) for world in names]
        if row not in SOUGHT and not any(entry["trials"] for entry in entries):
            continue
        cells = [f"{SOUGHT.get(row, ('',) * 4)[int(world[1]) - 1]} | {counted(entry)}"
                 for world, entry in zip(names, entries, strict=True)]
        lines.append(f"| {row} | " + " | ".join(cells) + f" | {_whole(entries)} |")
    if not short:
        every = figures.values()
        lines += [_plain(_UNIFORM, (number(one["null_p_values_uniform"], digits=2)
                                    for one in every)),
                  _plain(_TIME, (number(one["cpu_s"]["median"], " s", 2) for one in every))]
    return "\n".join(lines)


def sets_table(sets: Mapping[str, Mapping[str, Figures]]) -> str:
    """What was reached over all worlds in each of several sets of answers, a Markdown row each.

    Args:
        sets: figures of ``proof.json`` by world, by what the set is called. Rows are those in which
            something is sought.
    """
    lines = ["| all worlds | " + " | ".join(sets) + " |", "|---" * (1 + len(sets)) + "|"]
    for row in SOUGHT:
        entries = [[one for world in every.values() for one in world["rows"] if one["row"] == row]
                   for every in sets.values()]
        lines.append(f"| {row} | " + " | ".join(map(str, map(_whole, entries))) + " |")
    return "\n".join(lines)


def _whole(entries: Sequence[Figures]) -> Proportion:
    """One row of several worlds, counted together."""
    return Proportion(*(sum(one[key] for one in entries) for key in ("hits", "trials")))


def answered_of(figures: Mapping[str, Figures]) -> str:
    """How many cases of each world the figures count, in words."""
    return ", ".join(f"{len(one['each']) + len(one['failed'])} of {world.upper()}"
                     for world, one in figures.items())


def _plain(name: str, values: Iterable[str]) -> str:
    """A row of which nothing is sought."""
    return f"| {name} | " + " | ".join(f" | {value}" for value in values) + " | |"


def rivals_table(figures: Mapping[str, Figures]) -> str:
    """Errors on unseen runs beside those of the rivals, a Markdown row each.

    Worlds in which no rival was tried have no column; without any, the table is empty.
    """
    tried = {world: one["rivals"] for world, one in figures.items()
             if any(row["count"] for row in one["rivals"].values())}
    if not tried:
        return ""
    heads = (f"{world.upper()}, {max(row['count'] for row in rows.values())} cases: median | "
             "diagnosed model is better" for world, rows in tried.items())
    lines = ["| | " + " | ".join(heads) + " |", "|---" * (1 + 2 * len(tried)) + "|"]
    for name, words in RIVAL_WORDS.items():
        cells = (f"{number(rows[name]['median_mean_square'])} | "
                 f"{counted(rows[name]['diagnosed_is_better'])}" for rows in tried.values())
        lines.append(f"| {words} | " + " | ".join(cells) + " |")
    return "\n".join(lines)


def power(figures: Mapping[str, Figures]) -> dict[str, list[tuple[float, Trials]]]:
    """Of each world, for each bin of sigma_b its lower end and the effects: name, if named."""
    ends = (*BINS[1:], np.inf)
    return {world: [(low, [(str(e["name"]), bool(e["named"])) for e in one["seen"]
                           if low <= e["sigma_b"] < high])
                    for low, high in zip(BINS, ends, strict=True)]
            for world, one in figures.items()}


@styled
def draw_power_by_world(figures: Mapping[str, Figures]) -> Picture:
    """Share of effects named against what an ideal detector sees, a curve for each world."""
    figure, axes = new_axes(x="sigma_b, the spread of fault-free vehicles included",
                            y="share of effects named")
    place = np.arange(len(BINS), dtype=np.float64)
    for k, (world, bins) in enumerate(power(figures).items()):
        there = [(j, trials) for j, (_, trials) in enumerate(bins) if trials]
        if not there:
            continue
        at = place[[j for j, _ in there]] + 0.08 * (k - 0.5 * (len(figures) - 1))
        values = np.array([proportion(hit for _, hit in trials).value for _, trials in there])
        ends = np.array([clustered(trials) for _, trials in there]).reshape(-1, 2)
        arms = np.maximum(np.stack([values - ends[:, 0], ends[:, 1] - values]), 0.0)
        axes.errorbar(at, values, yerr=arms, marker="o", capsize=3, color=CYCLE[k],
                      label=f"{world.upper()} ({sum(len(trials) for _, trials in there)} effects)")
    axes.set_xticks(place, [_words(k) for k in range(len(BINS))])
    axes.set_ylim(-0.03, 1.03)
    axes.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=len(figures))
    words = "Bars: 95 % Wilson intervals; effects of one name are a cluster."
    return Picture("power", "Power", words, figure)


def _words(k: int) -> str:
    return f"{BINS[k]:g}–{BINS[k + 1]:g}" if k + 1 < len(BINS) else f"≥ {BINS[k]:g}"


def seen_effects(causes: Sequence[tuple[str, float | None, bool]]) -> list[dict[str, Any]]:
    """Effects whose sigma_b was measured, as plain objects."""
    return [{"name": name, "sigma_b": size, "named": named}
            for name, size, named in causes if size is not None]
