"""Estimate how a recorded run began: speed, course and pose from its first second."""

from __future__ import annotations

import numpy as np

from truck_blowout_sim.recordings import INPUT_NAMES, Recording
from truck_blowout_sim.simulation.equilibrium import InitialState
from truck_blowout_sim.simulation.inputs import Inputs, opening

_WINDOW_S = 1.0
_FIRST_INPUTS_S = 0.2
_MOVING_MPS = 1.0


def initial_state(recording: Recording) -> InitialState:
    """Initial state at the recording's first input sample.

    Channels that were not recorded leave their part at zero (lateral motion, pose); without any
    speed the truck starts from rest. Without a heading it points along its path, if it moves.
    """
    start = start_time_s(recording)
    yaw = _heading(recording, start)
    return InitialState(
        speed_mps=max(_speed(recording, start), 0.0),
        lateral_speed_mps=_value(recording, "tractor_vy_mps", start),
        yaw_rate_radps=_value(recording, "tractor_yaw_rate_radps", start),
        x_m=_value(recording, "tractor_x_m", start),
        y_m=_value(recording, "tractor_y_m", start),
        yaw_rad=yaw,
        articulation_rad=_articulation(recording, start, yaw),
        time_s=start,
        inputs=_first_inputs(recording, start),
    )


def start_time_s(recording: Recording) -> float:
    """Time of the first input sample, or of the first sample where no input was recorded."""
    times = [recording[n].time_s[0] for n in INPUT_NAMES if n in recording and len(recording[n])]
    return float(min(times)) if times else recording.start_s


def _heading(recording: Recording, start_s: float) -> float:
    """Recorded heading, else the direction of the first second's path, as of a log of positions."""
    places = [f"tractor_{axis}" for axis in ("x_m", "y_m")]
    if "tractor_yaw_rad" in recording or not set(places) <= set(recording.channels):
        return _value(recording, "tractor_yaw_rad", start_s)
    east, north = (recording[name].between(start_s, start_s + _WINDOW_S) for name in places)
    if min(len(east), len(north)) < 2:
        return 0.0
    speeds = [float(np.polyfit(s.time_s, s.value, 1)[0]) for s in (east, north)]
    if np.hypot(speeds[0], speeds[1]) < _MOVING_MPS:
        return 0.0
    # a straight line through the second has the direction of its middle
    turned = 0.5 * _WINDOW_S * _value(recording, "tractor_yaw_rate_radps", start_s)
    return float(np.arctan2(speeds[1], speeds[0])) - turned


def _speed(recording: Recording, start_s: float) -> float:
    """Forward speed; where its samples begin later than the run, the first of them (`silences`)."""
    name = "tractor_vx_mps"
    if name in recording and len(recording[name]):
        start_s = max(start_s, float(recording[name].time_s[0]))
    return _value(recording, name, start_s)


def _value(recording: Recording, name: str, start_s: float) -> float:
    """Value at ``start_s`` of a straight line through the first second, 0 if not recorded.

    Where there is no noise to average (metadata ``noise: none``), the first sample.
    """
    if name not in recording:
        return 0.0
    series = recording[name].between(start_s, start_s + _WINDOW_S)
    if len(series) < 3 or recording.metadata.get("noise") == "none":
        return float(series.value[0]) if len(series) else 0.0
    return float(np.polyval(np.polyfit(series.time_s - start_s, series.value, 1), 0.0))


def _articulation(recording: Recording, start_s: float, yaw_rad: float) -> float:
    """Trailer yaw minus tractor yaw, 0 where either is missing."""
    if "trailer_yaw_rad" not in recording or "tractor_yaw_rad" not in recording:
        return 0.0
    difference = _value(recording, "trailer_yaw_rad", start_s) - yaw_rad
    return float((difference + np.pi) % (2.0 * np.pi) - np.pi)


def _first_inputs(recording: Recording, start_s: float) -> Inputs:
    """Mean of the inputs over the first fifth of a second; 0 where not recorded."""
    times = np.linspace(start_s, start_s + _FIRST_INPUTS_S, 21)
    first = Inputs(*np.nan_to_num(recording.inputs_at(times)).mean(axis=0).tolist())
    return first._replace(throttle=opening(first.throttle, recording.name))
