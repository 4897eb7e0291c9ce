"""Blowouts in a step steer, Q1 to Q8: what the three-dimensional model gives beside the words."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from truck_blowout_sim.recordings import Recording
from truck_blowout_sim.simulation.run import simulate
from truck_blowout_sim.simulation.validation.rows import Row, at, window, yaw_rate_degps
from truck_blowout_sim.vehicle import Packed

_TRAILER, _DRIVE = "trailer_step_steer", "drive_step_steer"
_SHORT = {"left": "", "right": "_right", "outer": "_right_outer_dual", "none": "_no_blowout"}
_BLOWN_S, _END_S = 5.0, 12.0
_RATED_LOAD_N = 27_500.0  # 6,175 lb a single tire at 105-110 psi


def turning_rows(packed: Packed) -> list[Row]:
    """All 8 rows for one vehicle."""
    trailer = {case: simulate(packed, _TRAILER + tail) for case, tail in _SHORT.items()}
    drive = {case: simulate(packed, _DRIVE + tail) for case, tail in _SHORT.items()}
    return [*_single_dual(trailer), *_trailer(trailer), *_drive(drive)]


def turn_radius_m(run: Recording) -> float:
    """Radius of the tractor's path in the last second."""
    speed = window(run, "tractor_vx_mps", _END_S - 1.0, _END_S).mean()
    rate = window(run, "tractor_yaw_rate_radps", _END_S - 1.0, _END_S).mean()
    return float(speed / rate)


def _late(run: Recording, unit: str) -> float:
    """Yaw rate of the last second [deg/s]."""
    return float(yaw_rate_degps(run, unit, _END_S - 1.0, _END_S).mean())


def _first_second(run: Recording, normal: Recording, unit: str) -> float:
    """Largest change of yaw rate in the first second after the blowout, signed [deg/s]."""
    change = (yaw_rate_degps(run, unit, _BLOWN_S, _BLOWN_S + 1.0)
              - yaw_rate_degps(normal, unit, _BLOWN_S, _BLOWN_S + 1.0))
    return float(change[np.argmax(np.abs(change))])


def _outward_m(run: Recording, normal: Recording) -> float:
    """How far the trailer's path lies outside the normal circle at the end."""
    x, y = (window(normal, f"trailer_{k}_m", 6.0, _END_S) for k in "xy")
    # the circle through the normal path, least squares
    table = np.column_stack([x, y, np.ones_like(x)])
    a, b, c = np.linalg.lstsq(table, x * x + y * y, rcond=None)[0]
    radius = np.sqrt(c + 0.25 * (a * a + b * b))
    end = [at(run, f"trailer_{k}_m", _END_S) for k in "xy"]
    return float(np.hypot(end[0] - 0.5 * a, end[1] - 0.5 * b) - radius)


def tail_swing_m(run: Recording) -> float:
    """How much farther from the turn's center the trailer's middle runs than the tractor's."""
    radii = []
    for unit in ("trailer", "tractor"):
        speed = np.hypot(window(run, f"{unit}_vx_mps", _END_S - 1.0, _END_S),
                         window(run, f"{unit}_vy_mps", _END_S - 1.0, _END_S)).mean()
        rate = window(run, f"{unit}_yaw_rate_radps", _END_S - 1.0, _END_S).mean()
        radii.append(float(speed / rate))
    return radii[0] - radii[1]


def _single_dual(runs: Mapping[str, Recording]) -> list[Row]:
    run, normal = runs["outer"], runs["none"]
    rate = max(abs(_late(run, unit) - _late(normal, unit)) for unit in ("tractor", "trailer"))
    moved = abs(_outward_m(run, normal))
    load = float(np.max(window(run, "tire_fz_trailer_1_right_inner_n", 6.0, _END_S)))
    return [Row("Q1", "one outer dual: path and yaw unchanged, its partner carries the load",
                "yes; yaw rate within 0.1 deg/s, path within 0.3 m",
                f"yaw rate {rate:.2f} deg/s, path {moved:.2f} m; partner carries "
                f"{load / 1000.0:.0f} kN, {load / _RATED_LOAD_N:.1f} of its rating",
                rate < 0.1 and moved < 0.3,
                "overload" if load > _RATED_LOAD_N else "")]


def _trailer(runs: Mapping[str, Recording]) -> list[Row]:
    right, left, normal = runs["right"], runs["left"], runs["none"]
    dr, dl = (_first_second(run, normal, "trailer") for run in (right, left))
    out, late = tail_swing_m(right) - tail_swing_m(normal), _late(right, "trailer")
    late -= _late(normal, "trailer")
    radius = {case: turn_radius_m(run) for case, run in runs.items()}
    wider = 100.0 * (radius["right"] / radius["none"] - 1.0)
    inner = 100.0 * (radius["left"] / radius["none"] - 1.0)
    return [
        Row("Q2", "outer trailer duals matter more than inner", "yes",
            f"trailer yaw rate {dr:+.2f} (outer), {dl:+.2f} deg/s (inner) in the first second",
            abs(dr) > abs(dl)),
        Row("Q3", "outer trailer duals: trailer yaws on, its tail runs wide", "yes",
            f"trailer {dr:+.2f} deg/s at first, {late:+.2f} at the end; {out:+.2f} m farther "
            "out behind the tractor", dr > 0.0 and out > 0.0),
        Row("Q4", "outer trailer duals: radius of the combination", "“much larger”",
            f"{wider:+.1f} % ({radius['right']:.1f} against {radius['none']:.1f} m)", None,
            "not a test: a yaw-plane model gives -1 to -2 %"),
        Row("Q5", "inner trailer duals: trailer first yaws away, radius smaller", "yes (sign)",
            f"trailer {dl:+.2f} deg/s at first, radius {inner:+.2f} %", dl < 0.0 and inner < 0.0,
            "a yaw-plane model gives +0.13 deg/s and no change of radius"),
    ]


def _drive(runs: Mapping[str, Recording]) -> list[Row]:
    right, left, normal = runs["right"], runs["left"], runs["none"]
    dr, dl = (_first_second(run, normal, "tractor") for run in (right, left))
    late = _late(right, "tractor")
    peak = float(np.max(yaw_rate_degps(right, "tractor", _BLOWN_S, _END_S)))
    return [
        Row("Q6", "either drive blowout: more yaw into the turn", "yes",
            f"left {dl:+.2f}, right {dr:+.2f} deg/s in the first second", dl > 0.0 and dr > 0.0),
        Row("Q7", "left (inner) drive yaws more than right", "yes",
            f"left {dl:+.2f}, right {dr:+.2f} deg/s", None,
            "not a test: depends on the flat's drag and load sharing; load transfer says the "
            "reverse"),
        Row("Q8", "right drive with load loss: near a spin", "not reported",
            f"tractor at most {peak:.1f} deg/s, {late:.1f} at the end "
            f"(normal {_late(normal, 'tractor'):.1f})", None, "a warning, not a test"),
    ]
