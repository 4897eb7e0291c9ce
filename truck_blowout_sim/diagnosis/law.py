"""The plainest law of a force that nothing known explains.

The force history is fitted by one physical variable at a time, and by none (a constant while it
acts); the one that a left-out window predicts best is taken. What has the form of the model's probe
(a constant over an interval, a drag with speed, a side force with yaw rate times speed) can be put
into the vehicle.

References: leave-one-out cross-validation (Stone 1974); sparse laws after Brunton et al. 2016.
Known limits: one variable; windows of a second, so nothing faster than half a hertz shows.
Validated with: test/diagnosis/test_law.py (the law that made the data is found).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.locate import Wrenches
from truck_blowout_sim.diagnosis.runs import Run

Floats = NDArray[np.float64]
_COMPONENTS = {"fx_n": ("F_x", "N"), "fy_n": ("F_y", "N"), "mz_nm": ("M_z", "N m")}
_ACTING = 2.0  # standard errors from which a window counts as acting


@dataclass(frozen=True)
class Law:
    """A force in one physical variable.

    Attributes:
        component: fx_n, fy_n or mz_nm; ``body`` it acts on.
        variable: in symbols; ``factor`` multiplies it, ``sigma`` is its standard error.
        equation: for a person.
        explained: share of the weighted history that left-out windows confirm.
        values: packed parameters that put it into the model, if its form allows.
    """

    component: str
    body: str
    variable: str
    factor: float
    sigma: float
    equation: str
    explained: float
    values: Mapping[str, float]


def plainest_law(wrenches: Wrenches, run: Run) -> Law:
    """The law of the strongest component of a force history."""
    history = wrenches.history
    force = {"fx_n": (history.fx_n, history.fx_sigma_n), "fy_n": (history.fy_n, history.fy_sigma_n),
             "mz_nm": (history.mz_nm, history.mz_sigma_nm)}
    component = max(force, key=lambda c: float(np.sum((force[c][0] / force[c][1]) ** 2)))
    value, sigma = force[component]
    variables = _variables(run, history.time_s, np.abs(value) > _ACTING * sigma)
    scored = {name: _left_out(x / sigma, value / sigma) for name, x in variables.items()}
    best = min(scored, key=lambda name: scored[name])
    x = variables[best] / sigma
    factor = float(x @ (value / sigma) / (x @ x))
    total = float(np.sum((value / sigma) ** 2))
    symbol, unit = _COMPONENTS[component]
    equation = f"{symbol},{history.body} = {factor:.4g} * {best}  [{unit}]"
    return Law(component, history.body, best, factor, float((x @ x) ** -0.5), equation,
               max(1.0 - scored[best] / total, 0.0) if total > 0 else 0.0,
               _probe_values(component, history.body, best, factor, wrenches, value, sigma))


def _variables(run: Run, time_s: Floats, acting: NDArray[np.bool_]) -> dict[str, Floats]:
    """Physical variables at the windows' middles, as far as they were recorded."""
    def at(name: str) -> Floats | None:
        if name not in run.recording:
            return None
        series = run.recording[name]
        return np.asarray(np.interp(time_s, series.time_s, series.value))
    found = {"1 (constant while it acts)": acting.astype(np.float64)}
    v, r = at("tractor_vx_mps"), at("tractor_yaw_rate_radps")
    if v is not None:
        found |= {"v": v, "v^2": v * v}
    if v is not None and r is not None:
        found["v r"] = v * r
    for name, symbol in (("steering_wheel_angle_rad", "delta_hw"), ("throttle", "throttle"),
                         ("brake_pressure_trailer_pa", "p_trailer"),
                         ("brake_pressure_drive_pa", "p_drive"),
                         ("trailer_roll_rad", "phi_trailer")):
        value = at(name)
        if value is not None:
            found[symbol] = value
    return {name: x for name, x in found.items() if float(x @ x) > 0.0}


def _left_out(x: Floats, y: Floats) -> float:
    """Sum of squares with which each window is predicted from all others."""
    information, reach = float(x @ x), float(x @ y)
    rest = information - x * x
    factor = np.where(rest > 0.0, (reach - x * y) / np.where(rest > 0.0, rest, 1.0), 0.0)
    return float(np.sum((y - factor * x) ** 2))


def _probe_values(component: str, body: str, variable: str, factor: float, wrenches: Wrenches,
                  value: Floats, sigma: Floats) -> Mapping[str, float]:
    """Packed parameters of the law, empty if the probe has no such form."""
    unit = f"unit.{body}."
    if variable == "v" and component == "fx_n":
        return {unit + "probe_fx_law_nspm": -factor}
    if variable == "v r" and component == "fy_n":
        return {unit + "probe_fy_law_npmps2": factor}
    if variable.startswith("1"):
        acting = np.flatnonzero(np.abs(value) > _ACTING * sigma)
        half = 0.5 * wrenches.window_s
        return {unit + f"probe_{component}": factor,
                unit + "probe_start_s": float(wrenches.history.time_s[acting[0]] - half),
                unit + "probe_end_s": float(wrenches.history.time_s[acting[-1]] + half)}
    return {}
