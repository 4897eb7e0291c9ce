"""Figures of a sweep: an outcome over each key, over two keys, and what explains what."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.report.style import BLUE, INK, SOFT, VERMILION, Picture, new_figure, styled

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
_MOST_COLUMNS = 3
_PANEL_IN = (2.9, 2.6)
_LONG_LABEL = 9  # characters from which labels are written slanted


@styled
def outcome_picture(name: str, title: str, values: Floats, labels: Mapping[str, list[str]],
                    at: Mapping[str, Integers], *, rate: bool) -> Picture:
    """An outcome against each key: boxes over the runs at each value, or the share of runs."""
    keys = [key for key in labels if len(labels[key]) > 1] or list(labels)
    columns = min(len(keys), _MOST_COLUMNS)
    rows = -(-len(keys) // columns)
    figure = new_figure((_PANEL_IN[0] * max(columns, 2), _PANEL_IN[1] * rows + 0.3))
    panels = figure.subplots(rows, columns, squeeze=False, sharey=True)
    for panel in panels.flat[len(keys):]:
        panel.set_visible(False)
    for k, key in enumerate(keys):
        panel, sorted_values = panels.flat[k], [values[at[key] == g]
                                                for g in range(len(labels[key]))]
        places = np.arange(len(labels[key]))
        if rate:
            panel.bar(places, [v.mean() if v.size else 0.0 for v in sorted_values], color=BLUE,
                      width=0.7)
        else:
            panel.boxplot([v if v.size else [np.nan] for v in sorted_values], positions=places,
                          widths=0.6, whis=(5, 95), showfliers=False,
                          medianprops={"color": VERMILION, "linewidth": 2.0},
                          boxprops={"color": INK}, whiskerprops={"color": SOFT},
                          capprops={"color": SOFT})
        slanted = max(len(label) for label in labels[key]) > _LONG_LABEL
        panel.set_xticks(places, labels[key], rotation=35 if slanted else 0,
                         ha="right" if slanted else "center", fontsize=8)
        panel.set_xlabel(key)
    figure.supylabel(title, fontsize=9.5)
    caption = ("Share of the runs at each value of a key, over all values of the others." if rate
               else "Runs at each value of a key, over all values of the others: median, "
               "quartiles (box), 5 to 95 % (whiskers).")
    return Picture(name, title, caption, figure)


@styled
def pair_picture(name: str, title: str, values: Floats, keys: tuple[str, str],
                 labels: Mapping[str, list[str]], at: Mapping[str, Integers]) -> Picture:
    """The mean of an outcome over the two keys that explain most of it."""
    a, b = keys
    table = np.full((len(labels[b]), len(labels[a])), np.nan)
    for i in range(table.shape[0]):
        for j in range(table.shape[1]):
            here = values[(at[b] == i) & (at[a] == j)]
            if here.size:
                table[i, j] = here.mean()
    figure = new_figure((6.4, 0.45 * len(labels[b]) + 1.9))
    axes = figure.add_subplot()
    axes.grid(visible=False)
    image = axes.imshow(table, aspect="auto", origin="lower", cmap="cividis")
    slanted = max(len(label) for label in labels[a]) > _LONG_LABEL
    axes.set_xticks(range(len(labels[a])), labels[a], rotation=35 if slanted else 0,
                    ha="right" if slanted else "center", fontsize=8)
    axes.set_yticks(range(len(labels[b])), labels[b], fontsize=8)
    axes.set_xlabel(a)
    axes.set_ylabel(b)
    middle = 0.5 * (np.nanmin(table) + np.nanmax(table))
    for (i, j), value in np.ndenumerate(table):
        if np.isfinite(value):
            axes.text(j, i, f"{value:.3g}", ha="center", va="center", fontsize=8,
                      color="white" if value < middle else INK)
    figure.colorbar(image, ax=axes, label=title)
    return Picture(name, title, "Mean over the runs at each pair of the two keys that explain most "
                   "of this outcome.", figure)


@styled
def share_picture(keys: Sequence[str], shares: Mapping[str, Mapping[str, float]]) -> Picture:
    """Share of each outcome's variance that every key explains."""
    figure = new_figure((7.4, 0.42 * len(shares) + 1.4))
    axes = figure.add_subplot()
    left = np.zeros(len(shares))
    for key in keys:
        sizes = np.array([100.0 * row.get(key, 0.0) for row in shares.values()])
        axes.barh(range(len(shares)), sizes, left=left, height=0.65, label=key)
        left += sizes
    axes.set_yticks(range(len(shares)), list(shares), fontsize=8.5)
    axes.invert_yaxis()
    axes.set_xlim(0.0, 100.0)
    axes.set_xlabel("share of the variance between runs (%)")
    figure.legend(loc="outside upper left", ncols=2, fontsize=8)
    return Picture("shares", "What explains the outcomes",
                   "Variance of the mean at each value of a key over the variance of all runs. "
                   "The rest to 100 % is due to keys that act together.", figure)
