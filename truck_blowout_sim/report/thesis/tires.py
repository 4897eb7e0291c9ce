"""Figures 18 to 21: lateral force and aligning torque over slip angle and load, sound and flat."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from truck_blowout_sim.report.thesis.canvas import canvas
from truck_blowout_sim.simulation.thesis_data import OURS, THESIS, ThesisData

_LOADS_SHOWN = (1, 2, 4, 6, 8, 10)
_SHADES = ("#a6cee3", "#7fb3d5", "#4f94c4", "#1f78b4", "#135a8c", "#0b3c5d")


def tire_figure(data: ThesisData, stated: str, quantity: str, flat: bool) -> Figure:
    """One quantity, for the thesis sheet and for the test truck's tire."""
    figure, panels = canvas(stated, columns=2)
    for axes, sheet in zip(panels, (THESIS, OURS), strict=True):
        found = data.maps[sheet, flat]
        values = found.lateral_n / 1e3 if quantity == "lateral" else found.aligning_nm
        for shade, j in zip(_SHADES, _LOADS_SHOWN, strict=True):
            axes.plot(np.degrees(found.slip_rad), values[:, j], color=shade, zorder=3)
            top_at = int(np.argmax(values[:, j]))
            axes.annotate(f"{found.load_n[j] / 1e3:.0f} kN", color=shade, fontsize=8,
                          xy=(np.degrees(found.slip_rad[top_at]), values[top_at, j]),
                          xytext=(0, 2), textcoords="offset points", va="bottom",
                          ha="right" if top_at > 30 else "center")  # fmt: skip
        axes.set(xlabel="slip angle (deg)", title=sheet)
        axes.set_ylabel("lateral force (kN)" if quantity == "lateral" else "aligning torque (N m)")
    low, top = (f(axes.get_ylim()[k] for axes in panels) for k, f in enumerate((min, max)))
    for axes in panels:
        axes.set_ylim(low, 1.05 * top)
    return figure
