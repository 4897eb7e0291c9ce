"""Numbers that a truck may have but hardly does: the unit that they were probably in.

    wheel radius = speed / spin speed of a hub
    cornering    = speed * yaw rate

References: truck tires hold 0.5 to 1 MPa, those of cars from 0.15 MPa; wheels of road vehicles roll
on 0.25 to 0.65 m; no tire holds a road vehicle in 1.5 g.
Known limits: notes only. A wheel of 0.28 m in rad/s looks like one in km/h.
Validated with: test/recordings/test_odd_sizes.py.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.recordings.channels import UNITS
from truck_blowout_sim.recordings.recording import Recording
from truck_blowout_sim.recordings.units import GRAVITY_MPS2, find_unit

FloatArray = NDArray[np.float64]

_TIRE_PA, _BRAKE_PA = (1.5e5, 1.1e6), (2e4, 1.2e6)
_LEAST_TIRE_PA, _LEAST_BRAKE_PA = 2e4, 1e3
_ZERO_PA = 0.1  # below it nothing was measured, or the tire is flat
_NOISE = 0.05  # share of its largest value by which a pressure may be below zero
_PRESSURES = ("Pa", "kPa", "bar", "psi", "MPa")
# what speed over spin speed is, in place of a radius, for a spin speed taken for rad/s
_RADII = ((1 / 3.6, 0.03, "km/h taken for rad/s"), (1.0, 0.05, "m/s taken for rad/s"),
          (0.0524, 0.4, "rpm taken for rad/s"), (4.77, 0.4, "rad/s taken for rpm"))  # fmt: skip
_MOVING_MPS = 3.0
_FEWEST = 20
_MOST_CORNERING_MPS2 = 1.5 * GRAVITY_MPS2


def odd_sizes(recording: Recording) -> tuple[str, ...]:
    """Notes on channels whose numbers another unit would make ordinary."""
    return (*_low_pressures(recording), *_odd_wheels(recording), *_fast_turns(recording))


def _low_pressures(recording: Recording) -> Iterator[str]:
    for name, series in recording.channels.items():
        if not len(series):
            continue
        if name.startswith("tire_pressure_"):
            # a tire that burst is flat for most of the run
            size, least, usual = float(series.value.max()), _LEAST_TIRE_PA, _TIRE_PA
        elif name.startswith(("brake_pressure_", "brake_chamber_")):
            size, least, usual = float(series.value.max()), _LEAST_BRAKE_PA, _BRAKE_PA
            if series.value.min() < -_NOISE * size or _trembles(series.value):
                continue  # a gauge about zero
        else:
            continue
        words = _taken(size, usual)
        if _ZERO_PA < size < least and words:
            yield f"{name} is {size:.3g} Pa: reads like {words}"


def _trembles(values: FloatArray) -> bool:
    """Whether each sample is unlike the one before: noise, and no pressure that is applied."""
    return bool(np.std(np.diff(values)) > np.std(values))


def _taken(size_pa: float, usual: tuple[float, float]) -> str:
    """Which unit, taken for which, makes an ordinary pressure of an odd one."""
    for stated in _PRESSURES:
        fitting = [true for true in _PRESSURES
                   if usual[0] <= size_pa * _pascals(true) / _pascals(stated) <= usual[1]]
        if fitting and stated not in fitting:
            return f"{' or '.join(fitting)} taken for {stated}"
    return ""


def _pascals(name: str) -> float:
    unit = find_unit(name)
    return unit.factor if unit else 1.0


def _odd_wheels(recording: Recording) -> Iterator[str]:
    for name, series in recording.channels.items():
        unit = "trailer" if "trailer" in name else "tractor"
        speed = recording.channels.get(f"{unit}_vx_mps") or recording.channels.get("tractor_vx_mps")
        if not name.startswith("hub_speed_") or speed is None:
            continue
        at = speed.at(series.time_s)
        rolling = (at > _MOVING_MPS) & (series.value > 0.0)
        if np.count_nonzero(rolling) < _FEWEST:
            continue
        radius_m = float(np.median(at[rolling] / series.value[rolling]))
        for like_m, close, words in _RADII:
            if abs(radius_m / like_m - 1.0) < close:
                yield (f"{name} fits the speed with a wheel of {radius_m:.3g} m:"
                       f" reads like {words}")  # fmt: skip


def _fast_turns(recording: Recording) -> Iterator[str]:
    """A yaw rate that no tire allows at this speed."""
    for unit in UNITS:
        rate = recording.channels.get(f"{unit}_yaw_rate_radps")
        speed = recording.channels.get(f"{unit}_vx_mps")
        if rate is None or speed is None:
            continue
        cornering = np.abs(rate.value * speed.at(rate.time_s))
        there = cornering[np.isfinite(cornering)]
        # a tenth of the time: a truck that spins does it for seconds, and slides then
        most = float(np.percentile(there, 90.0)) if there.size >= _FEWEST else 0.0
        if most > _MOST_CORNERING_MPS2:
            yield (f"{unit}_yaw_rate_radps times the speed reaches {most:.0f} m/s2, more than tires"
                   " hold: reads like deg/s taken for rad/s, or the speed like km/h taken for m/s")
