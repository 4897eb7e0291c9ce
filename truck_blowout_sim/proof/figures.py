"""Figures of a run: power, verdicts, p-values of nulls, intervals, effect by effect."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from truck_blowout_sim.proof.by_effect import span
from truck_blowout_sim.proof.table import VERDICTS
from truck_blowout_sim.report.style import BLUE, CYCLE, SOFT, Picture, new_axes, styled

_CURVES = {"noticed": "noticed", "aliased": "truth in the alias set", "raw": "truth named first"}


def pictures(figures: Mapping[str, Any]) -> list[Picture]:
    """Those that the run has data for."""
    made = [draw_confusion(figures["confusion"])]
    if any(row["noticed"]["trials"] for row in figures["power"]):
        made.append(draw_power(figures["power"]))
    if len(figures["null_p_values"]) >= 5:
        made.append(draw_reliability(figures["null_p_values"]))
    if figures["parameters"]["count"] >= 5:
        made.append(draw_intervals(figures["parameters"]["intervals"]))
    if figures["effects"]:
        made.append(draw_effects(figures["effects"]))
    return made


@styled
def draw_power(rows: Sequence[Mapping[str, Any]]) -> Picture:
    """Share of single effects noticed and named, by visibility, with Wilson intervals."""
    figure, axes = new_axes(x="visibility (sigma)", y="share of single effects")
    filled = [row for row in rows if row["noticed"]["trials"]]
    place = np.arange(len(filled), dtype=np.float64)
    for k, (key, words) in enumerate(_CURVES.items()):
        values = np.array([row[key]["value"] for row in filled])
        ends = np.array([row[key]["wilson95"] for row in filled])
        # An interval's end and the value may differ by rounding where all or none hit.
        arms = np.maximum(np.stack([values - ends[:, 0], ends[:, 1] - values]), 0.0)
        axes.errorbar(place + 0.06 * (k - 1), values, yerr=arms, marker="o", capsize=3,
                      color=CYCLE[k], label=words)
    axes.set_xticks(place, [_span(row) for row in filled])
    axes.set_ylim(-0.03, 1.03)
    axes.legend(loc="upper left")
    return Picture("power", "Power", "Bars: 95 % Wilson intervals.", figure)


def _span(row: Mapping[str, Any]) -> str:
    low, high = row["sigma"]
    return f"{f'{low:g}–{high:g}' if high else f'≥ {low:g}'}\nn = {row['noticed']['trials']}"


@styled
def draw_confusion(table: Mapping[str, Mapping[str, int]]) -> Picture:
    """Verdicts by group, shaded by the share within the group."""
    figure, axes = new_axes((6.4, 3.6), x="verdict", y="concealed")
    counts = np.array([[row.get(v, 0) for v in VERDICTS] for row in table.values()], dtype=float)
    share = counts / counts.sum(axis=1, keepdims=True)
    axes.imshow(share, cmap="Blues", vmin=0.0, vmax=1.0, aspect="auto")
    axes.grid(visible=False)
    for i, j in np.ndindex(counts.shape):
        axes.text(j, i, f"{counts[i, j]:.0f}", ha="center", va="center",
                  color="white" if share[i, j] > 0.5 else "black")
    axes.set_xticks(range(len(VERDICTS)), [v.replace("_", "\n") for v in VERDICTS])
    axes.set_yticks(range(len(table)), list(table))
    return Picture("confusion", "Verdicts", "Number of cases.", figure)


@styled
def draw_effects(rows: Sequence[Mapping[str, Any]]) -> Picture:
    """Found of concealed for each effect and class of visibility."""
    figure, axes = new_axes((6.4, 1.1 + 0.23 * len(rows)), x="visibility (sigma)", y="")
    share = np.array([[np.nan if p["value"] is None else p["value"] for p in row["by_sigma"]]
                      for row in rows])
    axes.imshow(share, cmap="RdYlBu", vmin=-0.15, vmax=1.15, aspect="auto")
    axes.grid(visible=False)
    for i, row in enumerate(rows):
        for j, p in enumerate(row["by_sigma"]):
            if p["trials"]:
                axes.text(j, i, f"{p['hits']}/{p['trials']}", ha="center", va="center", size=8)
    axes.set_xticks(range(share.shape[1]), [span(k) for k in range(share.shape[1])])
    axes.set_yticks(range(len(rows)), [row["name"].replace("_", " ") for row in rows], size=8)
    return Picture("effects", "Found of concealed", "Blue: found; red: not.", figure)


@styled
def draw_reliability(p_values: Sequence[float]) -> Picture:
    """Share of null cases at or below each p-value; calibrated values follow the diagonal."""
    figure, axes = new_axes((4.2, 3.8), x="stated p-value", y="share of null cases at or below")
    n = len(p_values)
    axes.step([0.0, *p_values, 1.0], [0.0, *((k + 1) / n for k in range(n)), 1.0], where="post",
              color=BLUE)
    axes.plot([0, 1], [0, 1], color=SOFT, linestyle="--")
    return Picture("reliability", "p-values on nulls", f"{n} cases with nothing missing.", figure)


@styled
def draw_intervals(rows: Sequence[Mapping[str, Any]]) -> Picture:
    """Share of parameter intervals of each stated level that hold the truth."""
    figure, axes = new_axes((4.2, 3.8), x="stated probability of the interval",
                            y="share that holds the truth")
    stated, value = (np.array([row[key] for row in rows]) for key in ("stated", "value"))
    ends = np.array([row["wilson95"] for row in rows])
    arms = np.maximum(np.stack([value - ends[:, 0], ends[:, 1] - value]), 0.0)
    axes.errorbar(stated, value, yerr=arms, marker="o", capsize=3, color=BLUE)
    axes.plot([0.4, 1.0], [0.4, 1.0], color=SOFT, linestyle="--")
    axes.set_ylim(0.0, 1.03)
    return Picture("intervals", "Parameter intervals", f"{rows[0]['trials']} strengths that truth "
                   "and model state alike; bars: 95 % Wilson.", figure)
