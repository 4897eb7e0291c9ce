"""What happened in a run, in one line for a person."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.recordings import Recording
from truck_blowout_sim.vehicle.units import FOOT_M, MILE_PER_HOUR_MPS

_STANDING_MPS = 0.05


def summarize(recording: Recording) -> str:
    """One line: what burst, speeds, peak yaw rate, where it ended, whether it rolled over."""
    parts = [f"{'+'.join(event.tires)} blown at {event.time_s:g} s" for event in recording.blowouts]
    parts += [_speed(recording), _yaw(recording), _place(recording)]
    parts += _rolled_over(recording)
    return "; ".join(parts)


def _speed(recording: Recording) -> str:
    speed = recording["tractor_vx_mps"]
    first, last = speed.value[0] / MILE_PER_HOUR_MPS, speed.value[-1] / MILE_PER_HOUR_MPS
    standing = np.flatnonzero(np.abs(speed.value) < _STANDING_MPS)
    if first > 1.0 and standing.size:
        stop = int(standing[0])
        way_ft = _travelled(recording)[stop] / FOOT_M
        return f"{first:.1f} mph to standstill in {way_ft:.0f} ft at {speed.time_s[stop]:.1f} s"
    return f"{first:.1f} to {last:.1f} mph over {_travelled(recording)[-1] / FOOT_M:.0f} ft"


def _travelled(recording: Recording) -> NDArray[np.float64]:
    x, y = recording["tractor_x_m"].value, recording["tractor_y_m"].value
    return np.asarray(np.concatenate([[0.0], np.cumsum(np.hypot(np.diff(x), np.diff(y)))]))


def _yaw(recording: Recording) -> str:
    rate = recording["tractor_yaw_rate_radps"]
    peak = int(np.argmax(np.abs(rate.value)))
    side = "left" if rate.value[peak] > 0.0 else "right"
    size = abs(np.degrees(rate.value[peak]))
    if size < 0.05:
        return "no yaw"
    return f"yaw rate at most {size:.1f} deg/s to the {side}, at {rate.time_s[peak]:.1f} s"


def _place(recording: Recording) -> str:
    """Where the tractor ended, beside the straight line on which it started."""
    x, y = recording["tractor_x_m"].value, recording["tractor_y_m"].value
    yaw = recording["tractor_yaw_rad"].value[0]
    off = np.cos(yaw) * (y[-1] - y[0]) - np.sin(yaw) * (x[-1] - x[0])
    if abs(off) < 0.05:
        return "ended on the line it started on"
    side = "left" if off > 0.0 else "right"
    return f"ended {abs(off) / FOOT_M:.1f} ft {side} of the line it started on"


def _rolled_over(recording: Recording) -> list[str]:
    if unit := recording.metadata.get("rolled_over_unit"):
        return [f"the {unit} rolled over at {float(recording.metadata['rolled_over_s']):.2f} s"]
    return []
