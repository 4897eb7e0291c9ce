"""Figures 18 to 21: lateral force and aligning torque over slip angle and load, sound and flat."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from truck_blowout_sim.report.thesis.canvas import canvas
from truck_blowout_sim.simulation.thesis_data import OURS, THESIS, ThesisData

_LOADS_SHOWN = (1, 2, 4, 6, 8, 10)
_LABEL_GAP = 0.055  # of the height of the panel
_SHADES = ("#a6cee3", "#7fb3d5", "#4f94c4", "#1f78b4", "#135a8c", "#0b3c5d")


def tire_figure(data: ThesisData, stated: str, quantity: str, flat: bool) -> Figure:
    """One quantity, for the thesis sheet and for the test truck's tire."""
    figure, panels = canvas(stated, columns=2)
    for axes, sheet in zip(panels, (THESIS, OURS), strict=True):
        found = data.maps[sheet, flat]
        values = found.lateral_n / 1e3 if quantity == "lateral" else found.aligning_nm
        for shade, j in zip(_SHADES, _LOADS_SHOWN, strict=True):
            axes.plot(np.degrees(found.slip_rad), values[:, j], color=shade, zorder=3)
        axes.set(xlabel="slip angle (deg)", title=sheet)
        axes.set_ylabel("lateral force (kN)" if quantity == "lateral" else "aligning torque (N m)")
    low, top = (f(axes.get_ylim()[k] for axes in panels) for k, f in enumerate((min, max)))
    for axes, sheet in zip(panels, (THESIS, OURS), strict=True):
        axes.set_ylim(low, 1.05 * top)
        _name_curves(axes, data.maps[sheet, flat].load_n, _LABEL_GAP * (top - low))
    return figure


def _name_curves(axes: Axes, loads_n: NDArray[np.float64], gap: float) -> None:
    """The load above the peak of each curve, never closer than ``gap`` to the one below."""
    above = -np.inf
    for line, j in zip(axes.lines, _LOADS_SHOWN, strict=True):
        slip_deg, values = np.asarray(line.get_xdata()), np.asarray(line.get_ydata())
        top_at = int(np.argmax(values))
        above = max(float(values[top_at]), above + gap)
        axes.annotate(f"{loads_n[j] / 1e3:.0f} kN", color=line.get_color(), fontsize=8,
                      xy=(slip_deg[top_at], above), xytext=(0, 2), textcoords="offset points",
                      va="bottom", ha="right" if top_at > 30 else "center")  # fmt: skip
