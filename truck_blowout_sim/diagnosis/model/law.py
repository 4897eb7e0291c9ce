"""The plainest law of a force that nothing known explains.

The strongest component of the force history is fitted by a sum of few terms, each a factor times a
physical variable, or by none (a constant while it acts). A term is taken if left-out windows are
then predicted clearly better. A law in what the model's probe knows (speed, its square, yaw rate
times speed, roll, a constant over an interval) can be put into the vehicle; it is, unless runs that
were never fitted are predicted worse with it.

References: leave-one-out residuals e / (1 - h) (Allen 1974); forward selection of sparse laws after
Brunton et al. 2016.
Known limits: two terms; windows of a second, so nothing faster than half a hertz shows.
Validated with: test/diagnosis/test_law.py (the law that made the data is found).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.case.runs import Run
from truck_blowout_sim.diagnosis.locate.wrench import Wrenches

Floats = NDArray[np.float64]
CONSTANT = "1 (constant while it acts)"
_COMPONENTS = {"fx_n": ("F_x", "N"), "fy_n": ("F_y", "N"), "mz_nm": ("M_z", "N m")}
_ACTING = 2.0  # standard errors from which a window counts as acting
_MOST_TERMS = 2
_WORTH_A_TERM = 0.1  # of the history's weighted squares, by which a further term must help
_FULL = 0.999  # leverage of a window that alone decides a factor
_COMMANDS = (("steering_wheel_angle_rad", "delta_hw"), ("throttle", "throttle"),
             ("brake_pressure_trailer_pa", "p_trailer"), ("brake_pressure_drive_pa", "p_drive"))
# What of each component the model's probe knows, by variable.
_PROBE = {
    "fx_n": {"v": "fx_v_nspm", "v^2": "fx_vv_ns2pm2", "v r": "fx_vr_kg", "phi": "fx_roll_nprad"},
    "fy_n": {"v": "fy_v_nspm", "v^2": "fy_vv_ns2pm2", "v r": "fy_vr_kg", "phi": "fy_roll_nprad"},
    "mz_nm": {"v": "mz_v_ns", "v^2": "mz_vv_ns2pm", "v r": "mz_vr_kgm", "phi": "mz_roll_nmprad"},
}


@dataclass(frozen=True)
class Law:
    """A force as a short sum of physical variables.

    Attributes:
        body: it acts on.
        terms: variable in symbols and the factor that multiplies it, the most telling first.
        equation: for a person.
        explained: share of the weighted history that left-out windows confirm.
        values: packed parameters that put it into the model, if its form allows.
        unseen: sum of squares of the holdout without and with it, if that was asked.
    """

    body: str
    terms: tuple[tuple[str, float], ...]
    equation: str
    explained: float
    values: Mapping[str, float]
    unseen: tuple[float, float] | None = None

    @property
    def helps(self) -> bool:
        """Whether it can be put into the model, and no run that was never fitted speaks against."""
        return bool(self.values) and (self.unseen is None or self.unseen[1] < self.unseen[0])


def plainest_law(wrenches: Wrenches, run: Run) -> Law:
    """The law of the strongest component of a force history."""
    history = wrenches.history
    force = {"fx_n": (history.fx_n, history.fx_sigma_n), "fy_n": (history.fy_n, history.fy_sigma_n),
             "mz_nm": (history.mz_nm, history.mz_sigma_nm)}
    component = max(force, key=lambda c: float(np.sum((force[c][0] / force[c][1]) ** 2)))
    value, sigma = force[component]
    acting = np.abs(value) > _ACTING * sigma
    variables = _variables(run, history.body, history.time_s, acting)
    if not variables:
        none = ((CONSTANT, 0.0),)
        return Law(history.body, none, _equation(component, history.body, none), 0.0, {})
    names, left = _selected({n: x / sigma for n, x in variables.items()}, value / sigma)
    design = np.stack([variables[n] / sigma for n in names], axis=1)
    factors = np.linalg.lstsq(design, value / sigma, rcond=None)[0]
    terms = tuple(zip(names, factors.tolist(), strict=True))
    total = float(np.sum((value / sigma) ** 2))
    return Law(history.body, terms, _equation(component, history.body, terms),
               max(1.0 - left / total, 0.0) if total > 0 else 0.0,
               _probe_values(component, history.body, terms, wrenches, acting))


def _variables(run: Run, body: str, time_s: Floats, acting: NDArray[np.bool_]
               ) -> dict[str, Floats]:
    """Physical variables at the windows' middles, as far as they were recorded."""
    def at(*names: str) -> Floats | None:
        series = next((run.recording[n] for n in names if n in run.recording), None)
        return None if series is None else np.asarray(
            np.interp(time_s, series.time_s, series.value))
    found = {CONSTANT: acting.astype(np.float64)}
    v = at(f"{body}_vx_mps", "tractor_vx_mps")
    r = at(f"{body}_yaw_rate_radps", "tractor_yaw_rate_radps")
    if v is not None:
        found |= {"v": v, "v^2": v * v}
    if v is not None and r is not None:
        found["v r"] = v * r
    others = {symbol: at(name) for name, symbol in ((f"{body}_roll_rad", "phi"), *_COMMANDS)}
    found |= {symbol: x for symbol, x in others.items() if x is not None}
    return {name: x for name, x in found.items() if float(x @ x) > 0.0}


def _selected(variables: Mapping[str, Floats], value: Floats) -> tuple[list[str], float]:
    """Names of the terms, best first, and the squares that left-out windows leave."""
    chosen: list[str] = []
    left = float(value @ value)
    while len(chosen) < _MOST_TERMS and CONSTANT not in chosen:
        tried = {name: _left_out(np.stack([variables[n] for n in (*chosen, name)], axis=1), value)
                 for name in variables if name not in chosen and not (chosen and name == CONSTANT)}
        best = min(tried, key=lambda name: tried[name], default="")
        if chosen and (not best or tried[best] > left - _WORTH_A_TERM * float(value @ value)):
            break
        chosen.append(best)
        left = tried[best]
    return chosen, left


def _left_out(design: Floats, value: Floats) -> float:
    """Sum of squares with which each window is predicted from all others."""
    q, _ = np.linalg.qr(design)
    leverage = np.minimum(np.sum(q * q, axis=1), _FULL)
    return float(np.sum(((value - q @ (q.T @ value)) / (1.0 - leverage)) ** 2))


def _equation(component: str, body: str, terms: tuple[tuple[str, float], ...]) -> str:
    symbol, unit = _COMPONENTS[component]
    name, factor = terms[0]
    said = f"{symbol},{body} = {factor:.4g} " + (name[2:] if name == CONSTANT else f"* {name}")
    said += "".join(f" {'-' if k < 0 else '+'} {abs(k):.4g} * {name}" for name, k in terms[1:])
    return f"{said}  [{unit}]"


def _probe_values(component: str, body: str, terms: tuple[tuple[str, float], ...],
                  wrenches: Wrenches, acting: NDArray[np.bool_]) -> Mapping[str, float]:
    """Packed parameters of the law, empty if the probe does not know one of its variables."""
    unit, known = f"unit.{body}.probe_", _PROBE[component]
    if terms[0][0] == CONSTANT:
        windows, half = np.flatnonzero(acting), 0.5 * wrenches.window_s
        return {unit + component: terms[0][1],
                unit + "start_s": float(wrenches.history.time_s[windows[0]] - half),
                unit + "end_s": float(wrenches.history.time_s[windows[-1]] + half)}
    if not all(name in known for name, _ in terms):
        return {}
    return {unit + known[name]: factor for name, factor in terms}
