"""Channels held against each other: a wrong unit shows as the ratio of two units.

    yaw rate      = d(heading)/dt
    speed         = length of d(position)/dt
    lateral force = speed * yaw rate (steady)
    forward force = d(speed)/dt - yaw rate * side velocity, but for a constant
    yaw rate      = turning of the path, in sign
    upward force  = 9.81 m/s2 in the mean

References: planar kinematics of a rigid body; ISO 8855.
Known limits: notes only; a drive without a turn or a change of place shows nothing; without a side
velocity, the forward force of a vehicle that spins can seem to be in another unit.
Validated with: test/recordings/test_mapping.py.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.recordings.channels import UNITS
from truck_blowout_sim.recordings.gravity import gravity_is_removed
from truck_blowout_sim.recordings.recording import Recording
from truck_blowout_sim.recordings.units import FOOT_M, GRAVITY_MPS2, MILE_M

FloatArray = NDArray[np.float64]

_DEG = 180.0 / math.pi
_MPH = 3600.0 / MILE_M  # of 1 m/s
_HEADING, _PLACE, _TURN, _GRAVITY = "yaw_rad", "its position", "speed times yaw rate", "gravity"
_PATH, _CHANGE = "the turning of its path", "its change of speed"
_MPH_IN_KMH = MILE_M / 1e3
# what a channel is held against: ratio of its number to what that says, and what the ratio means
_MISTAKES: dict[str, tuple[tuple[float, str], ...]] = {
    _HEADING: ((_DEG, "reads like deg taken for rad"), (1 / _DEG, "reads like rad taken for deg")),
    _PATH: ((_DEG, "reads like deg/s taken for rad/s"), (1 / _DEG, "reads like rad/s taken for"
                                                                   " deg/s")),
    _PLACE: (
        (3.6, "reads like km/h taken for m/s"), (1 / 3.6, "reads like m/s taken for km/h"),
        (_MPH, "reads like mph taken for m/s"), (1 / _MPH, "reads like m/s taken for mph"),
        (FOOT_M, "the position reads like ft taken for m"),
        (1 / FOOT_M, "the position reads like m taken for ft"),
        (1e3, "the position reads like km taken for m"),
        (1e-3, "the position reads like m taken for km"),
    ),
    _TURN: (
        (GRAVITY_MPS2, "reads like m/s2 taken for g"),
        (1 / GRAVITY_MPS2, "reads like g taken for m/s2"),
        (1 / _DEG, "the yaw rate reads like deg/s taken for rad/s"),
        (_DEG, "the yaw rate reads like rad/s taken for deg/s"),
        (1 / 3.6, "the speed reads like km/h taken for m/s"),
        (3.6, "the speed reads like m/s taken for km/h"),
    ),
    _CHANGE: (
        (_MPH_IN_KMH, "the speed reads like mph taken for km/h"),
        (1 / _MPH_IN_KMH, "the speed reads like km/h taken for mph"),
        (1 / 3.6, "the speed reads like km/h taken for m/s"),
        (3.6, "the speed reads like m/s taken for km/h"),
        (1 / _MPH, "the speed reads like mph taken for m/s"),
        (_MPH, "the speed reads like m/s taken for mph"),
        (GRAVITY_MPS2, "reads like m/s2 taken for g"),
        (1 / GRAVITY_MPS2, "reads like g taken for m/s2"),
    ),
    _GRAVITY: ((GRAVITY_MPS2, "reads like m/s2 taken for g"),
               (1 / GRAVITY_MPS2, "reads like g taken for m/s2")),
}  # fmt: skip
_OPPOSITE = (-1.0, "reads like the opposite sign")
_WRONG_HEADING = "the heading reads like deg taken for rad"
_WEIGHTLESS = 0.05  # of gravity: below 1/9.8, which is another unit
_CLOSE = 0.12
_TURN_CLOSE = 0.25  # a body that rolls adds gravity to its lateral acceleration
_FAR_OFF = 20.0  # a turning path is noisy, and tells only its sign and a factor of 57
_ALIKE = 0.8  # correlation below which two channels say nothing about each other
_STEP_S = 0.1
_FEWEST = 20
_MOVING_MPS = 3.0


def contradictions(recording: Recording) -> tuple[str, ...]:
    """Notes on channels that contradict another by the ratio of two units, or by sign."""
    notes = []
    ratios = list(_ratios(recording))
    sound = {name.partition("_")[0] for name, other, ratio in ratios
             if other == _TURN and abs(ratio - 1.0) < _TURN_CLOSE}  # fmt: skip
    for name, other, ratio in ratios:
        if other == _GRAVITY and abs(ratio) < _WEIGHTLESS:
            unit = name.partition("_")[0]
            notes.append(f"{name} is {ratio:.2g} times gravity: reads like accelerations without"
                         f" it; if so, map metadata: {{{unit}_accelerometers: gravity removed}}")
        words = _meaning(other, ratio)
        if other == _HEADING and 0.0 < ratio * _DEG < 2.0 and name.partition("_")[0] in sound:
            words = words and _WRONG_HEADING  # the rate agrees with the lateral acceleration
        if words:
            notes.append(f"{name} is {ratio:.3g} times what {other} says: {words}")
    return tuple(notes)


def _meaning(other: str, ratio: float) -> str:
    """The mistake nearest to a ratio; empty if none is near."""
    if ratio == 0.0:
        return ""
    misses = [(abs(ratio / mistake - 1.0), words) for mistake, words in
              (*_MISTAKES[other], _OPPOSITE)]  # fmt: skip
    miss, words = min(misses)
    return words if miss < (_TURN_CLOSE if other == _TURN else _CLOSE) else ""


def _ratios(recording: Recording) -> Iterator[tuple[str, str, float]]:
    times = np.arange(recording.start_s, recording.end_s, _STEP_S)
    if times.size < _FEWEST:
        return
    for unit in UNITS:
        have = {stem: recording.at(f"{unit}_{stem}", times)
                for stem in ("yaw_rad", "yaw_rate_radps", "x_m", "y_m", "vx_mps", "vy_mps",
                             "ax_mps2", "ay_mps2")
                if f"{unit}_{stem}" in recording}  # fmt: skip
        rate, speed = have.get("yaw_rate_radps"), have.get("vx_mps")
        if rate is not None and "yaw_rad" in have:
            yield from _pair(unit, "yaw_rate_radps", _HEADING, rate,
                             np.gradient(have["yaw_rad"], times))  # fmt: skip
        if speed is not None and {"x_m", "y_m"} <= have.keys():
            moved = np.hypot(np.gradient(have["x_m"], times), np.gradient(have["y_m"], times))
            yield from _mean_pair(unit, "vx_mps", _PLACE, speed, moved)
            if rate is not None and np.nanmin(moved) > _MOVING_MPS:
                yield from _sign(unit, "yaw_rate_radps", _PATH, rate,
                                 _path_rate(have["x_m"], have["y_m"], times))  # fmt: skip
        if "ay_mps2" in have and rate is not None and speed is not None:
            yield from _pair(unit, "ay_mps2", _TURN, have["ay_mps2"], speed * rate)
        if "ax_mps2" in have and speed is not None:
            pushed = np.gradient(speed, times)
            if rate is not None and "vy_mps" in have:
                pushed = pushed - rate * have["vy_mps"]
            along = (_over_a_second(side) for side in (have["ax_mps2"], pushed))
            yield from _pair(unit, "ax_mps2", _CHANGE, *(side - np.nanmean(side) for side in along))
        up = f"{unit}_az_mps2"
        if up in recording and not gravity_is_removed(recording, unit):
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
    """1 or -1 where the two go together over a second; the ratio itself only if it is far off."""
    a, b = _over_a_second(one), _over_a_second(reference)
    if a.size >= _FEWEST and np.std(a) > 0.0 and np.std(b) > 0.0:
        together = float(np.corrcoef(a, b)[0, 1])
        if abs(together) > _ALIKE:
            slope = abs(float(np.sum(a * b) / np.sum(b * b)))
            size = slope if max(slope, 1.0 / slope) > _FAR_OFF else 1.0
            yield f"{unit}_{stem}", other, math.copysign(size, together)


def _over_a_second(values: FloatArray) -> FloatArray:
    second = np.full(round(1.0 / _STEP_S), _STEP_S)
    return np.asarray(np.convolve(values, second, mode="valid"), dtype=np.float64)


def _mean_pair(unit: str, stem: str, other: str, one: FloatArray, reference: FloatArray
               ) -> Iterator[tuple[str, str, float]]:  # fmt: skip
    there = np.isfinite(one) & (reference > 0.0) & (np.maximum(one, reference) > _MOVING_MPS)
    if np.count_nonzero(there) >= _FEWEST:
        yield f"{unit}_{stem}", other, float(np.median(one[there] / reference[there]))
