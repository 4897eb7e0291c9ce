"""What happened in a run, in one line for a person."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.recordings import Recording
from truck_blowout_sim.simulation.measures import STANDING_MPS, whole_speed
from truck_blowout_sim.vehicle.units import FOOT_M, MILE_PER_HOUR_MPS

_MOVING_MPS = 0.5
_FOLDED_DEG, _TOUCHING_DEG = 45.0, 90.0


@dataclass(frozen=True)
class _Units:
    """Names of a unit of speed and one of length, and their sizes in SI."""

    speed: str
    speed_mps: float
    length: str
    length_m: float


_UNITS = {"us": _Units("mph", MILE_PER_HOUR_MPS, "ft", FOOT_M), "si": _Units("m/s", 1.0, "m", 1.0)}


def summarize(recording: Recording, units: str = "us") -> str:
    """One line: what burst, speeds, peak yaw rate, where it ended, whether it jackknifed or rolled.

    Args:
        recording: of a run.
        units: ``us`` (mph, ft) or ``si`` (m/s, m).
    """
    shown = _UNITS[units]
    parts = [f"{'+'.join(event.tires)} blown at {event.time_s:g} s" for event in recording.blowouts]
    parts += [_speed(recording, shown), _yaw(recording), _place(recording, shown)]
    parts += _folded(recording) + _rolled_over(recording)
    return "; ".join(parts)


def _speed(recording: Recording, units: _Units) -> str:
    forward, lateral = recording["tractor_vx_mps"], recording["tractor_vy_mps"]
    speed = whole_speed(forward.value, lateral.value)
    first, last = speed[0], speed[-1]
    start = _tenths(first / units.speed_mps)
    standing = np.flatnonzero(np.abs(speed) < STANDING_MPS)
    if first > _MOVING_MPS and standing.size:
        stop = int(standing[0])
        way = _travelled(recording)[stop] / units.length_m
        return (f"{start} {units.speed} to standstill in {way:.0f} {units.length}"
                f" at {forward.time_s[stop]:.1f} s{_again(float(forward.value[-1]), units)}")
    way = _travelled(recording)[-1] / units.length_m
    return (f"{start} to {_tenths(last / units.speed_mps)} {units.speed}"
            f" over {way:.0f} {units.length}")


def _again(speed_mps: float, units: _Units) -> str:
    """Words on a truck that stood and rolls at the end."""
    if abs(speed_mps) < STANDING_MPS:
        return ""
    return (f", then rolling {'on' if speed_mps > 0.0 else 'back'},"
            f" {_tenths(abs(speed_mps) / units.speed_mps)} {units.speed} at the end")


def _tenths(value: float) -> str:
    return f"{round(float(value), 1) + 0.0:.1f}"  # no "-0.0" of a truck that stands


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


def _place(recording: Recording, units: _Units) -> str:
    """Where the tractor ended, beside the straight line on which it started."""
    x, y = recording["tractor_x_m"].value, recording["tractor_y_m"].value
    yaw = recording["tractor_yaw_rad"].value[0]
    off = np.cos(yaw) * (y[-1] - y[0]) - np.sin(yaw) * (x[-1] - x[0])
    if abs(off) < 0.05:
        return "ended on the line it started on"
    side = "left" if off > 0.0 else "right"
    return f"ended {abs(off) / units.length_m:.1f} {units.length} {side} of the line it started on"


def _folded(recording: Recording) -> list[str]:
    """Articulation beyond that of a road's bends; where cabs touch trailers, the model ends."""
    if "articulation_rad" not in recording:
        return []
    angle = recording["articulation_rad"]
    degrees = np.abs(np.degrees(angle.value))
    beyond = np.flatnonzero(degrees > _TOUCHING_DEG)
    if beyond.size:
        return [f"articulation passed {_TOUCHING_DEG:.0f} deg at {angle.time_s[beyond[0]]:.1f} s:"
                " contact of tractor and trailer is not simulated"]
    peak = int(np.argmax(degrees))
    if degrees[peak] < _FOLDED_DEG:
        return []
    return [f"articulation at most {degrees[peak]:.0f} deg, at {angle.time_s[peak]:.1f} s"]


def _rolled_over(recording: Recording) -> list[str]:
    if unit := recording.metadata.get("rolled_over_unit"):
        return [f"the {unit} rolled over at {float(recording.metadata['rolled_over_s']):.2f} s"]
    return []
