"""Channels held against each other: a wrong unit shows as the ratio of two units.

    yaw rate      = d(heading)/dt
    speed         = length of d(position)/dt
    lateral force = speed * yaw rate (steady)
    yaw rate      = turning of the path, in sign
    upward force  = 9.81 m/s2 in the mean

References: planar kinematics of a rigid body; ISO 8855.
Known limits: notes only; a drive without a turn or a change of place shows nothing.
Validated with: test/recordings/test_mapping.py.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.recordings.channels import UNITS
from truck_blowout_sim.recordings.recording import Recording
from truck_blowout_sim.recordings.units import GRAVITY_MPS2

FloatArray = NDArray[np.float64]

# ratio of the number to what it should be, and what that means
_MISTAKES = (
    (180.0 / math.pi, "reads like deg taken for rad"),
    (math.pi / 180.0, "reads like rad taken for deg"),
    (3.6, "reads like km/h taken for m/s"),
    (1 / 3.6, "reads like m/s taken for km/h"),
    (3600.0 / 1609.344, "reads like mph taken for m/s"),
    (1609.344 / 3600.0, "reads like m/s taken for mph"),
    (GRAVITY_MPS2, "reads like m/s2 taken for g"),
    (1 / GRAVITY_MPS2, "reads like g taken for m/s2"),
    (-1.0, "reads like the opposite sign"),
)
_GRAVITY, _WEIGHTLESS = "gravity", 0.05  # below 1/9.8, which is another unit
_CLOSE = 0.12
_ALIKE = 0.8  # correlation below which two channels say nothing about each other
_STEP_S = 0.1
_FEWEST = 20
_MOVING_MPS = 3.0


def contradictions(recording: Recording) -> tuple[str, ...]:
    """Notes on channels that contradict another by the ratio of two units, or by sign."""
    notes = []
    for name, other, ratio in _ratios(recording):
        if other == _GRAVITY and abs(ratio) < _WEIGHTLESS:
            notes.append(f"{name} is {ratio:.2g} times gravity: reads like accelerations without"
                         " it; if so, map metadata: {accelerometers: gravity removed}")
        for mistake, words in _MISTAKES:
            if abs(ratio / mistake - 1.0) < _CLOSE:
                notes.append(f"{name} is {ratio:.3g} times what {other} says: {words}")
    return tuple(notes)


def _ratios(recording: Recording) -> Iterator[tuple[str, str, float]]:
    times = np.arange(recording.start_s, recording.end_s, _STEP_S)
    if times.size < _FEWEST:
        return
    for unit in UNITS:
        have = {stem: recording.at(f"{unit}_{stem}", times)
                for stem in ("yaw_rad", "yaw_rate_radps", "x_m", "y_m", "vx_mps", "ay_mps2")
                if f"{unit}_{stem}" in recording}  # fmt: skip
        rate, speed = have.get("yaw_rate_radps"), have.get("vx_mps")
        if rate is not None and "yaw_rad" in have:
            yield from _pair(unit, "yaw_rate_radps", "yaw_rad", rate,
                             np.gradient(have["yaw_rad"], times))  # fmt: skip
        if speed is not None and {"x_m", "y_m"} <= have.keys():
            moved = np.hypot(np.gradient(have["x_m"], times), np.gradient(have["y_m"], times))
            yield from _mean_pair(unit, "vx_mps", "its position", speed, moved)
            if rate is not None and np.nanmin(moved) > _MOVING_MPS:
                yield from _sign(unit, "yaw_rate_radps", "the turning of its path", rate,
                                 _path_rate(have["x_m"], have["y_m"], times))  # fmt: skip
        if "ay_mps2" in have and rate is not None and speed is not None:
            yield from _pair(unit, "ay_mps2", "speed times yaw rate", have["ay_mps2"], speed * rate)
        up = f"{unit}_az_mps2"
        if up in recording and "removed" not in recording.metadata.get("accelerometers", ""):
            yield up, _GRAVITY, float(np.median(recording[up].value)) / GRAVITY_MPS2


def _pair(unit: str, stem: str, other: str, one: FloatArray, reference: FloatArray
          ) -> Iterator[tuple[str, str, float]]:  # fmt: skip
    """Slope of one on the other where they go together."""
    there = np.isfinite(one) & np.isfinite(reference)
    a, b = one[there], reference[there]
    if a.size < _FEWEST or np.std(a) == 0.0 or np.std(b) == 0.0:
        return
    if abs(float(np.corrcoef(a, b)[0, 1])) > _ALIKE:
        yield f"{unit}_{stem}", other, float(np.sum(a * b) / np.sum(b * b))


def _path_rate(x_m: FloatArray, y_m: FloatArray, times: FloatArray) -> FloatArray:
    course = np.unwrap(np.arctan2(np.gradient(y_m, times), np.gradient(x_m, times)))
    return np.asarray(np.gradient(course, times), dtype=np.float64)


def _sign(unit: str, stem: str, other: str, one: FloatArray, reference: FloatArray
          ) -> Iterator[tuple[str, str, float]]:  # fmt: skip
    """1 or -1 where the two go together over a second; noise of positions spoils more than that."""
    second = np.full(round(1.0 / _STEP_S), _STEP_S)
    a, b = (np.convolve(values, second, mode="valid") for values in (one, reference))
    if a.size >= _FEWEST and np.std(a) > 0.0 and np.std(b) > 0.0:
        together = float(np.corrcoef(a, b)[0, 1])
        if abs(together) > _ALIKE:
            yield f"{unit}_{stem}", other, math.copysign(1.0, together)


def _mean_pair(unit: str, stem: str, other: str, one: FloatArray, reference: FloatArray
               ) -> Iterator[tuple[str, str, float]]:  # fmt: skip
    there = np.isfinite(one) & np.isfinite(reference) & (reference > _MOVING_MPS)
    if np.count_nonzero(there) >= _FEWEST:
        yield f"{unit}_{stem}", other, float(np.median(one[there] / reference[there]))
