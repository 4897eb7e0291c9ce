"""Quantities that a mapping may name beside the table's channels, and the channels they become.

`tractor_latitude_rad` and `tractor_longitude_rad` become `tractor_x_m` (east) and `tractor_y_m`
(north); `tractor_altitude_m` refines them. `brake_pressure_pa`, a pressure that acts on all
circuits, becomes the pressure of each.

Validated with: test/recordings/test_stand_ins.py.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from truck_blowout_sim.recordings.channels import INPUT_NAMES, UNITS, Channel, by_name, channels_for
from truck_blowout_sim.recordings.mapping.geodesy import east_north_m
from truck_blowout_sim.recordings.recording import Series

ALL_CIRCUITS = "brake_pressure_pa"
CIRCUITS = tuple(name for name in INPUT_NAMES if name.startswith("brake_pressure_"))
ORIGIN_DEG = "map_origin_deg"
_STEMS = ("latitude_rad", "longitude_rad", "altitude_m")


class StandInError(ValueError):
    """What was named does not make a channel; says which name, and what is expected."""

    def __init__(self, name: str, problem: str, expected: str) -> None:
        super().__init__(problem)
        self.name, self.expected = name, expected


def stand_ins() -> tuple[Channel, ...]:
    """Rows of these quantities, as the table of channels has them."""
    pressure = by_name(channels_for())[CIRCUITS[0]]
    bounds = {"latitude_rad": math.pi / 2.0, "longitude_rad": 2.0 * math.pi, "altitude_m": 1.0e4}
    rows = [Channel(ALL_CIRCUITS, "Pa", "control pressure of all brake circuits, gauge", "input",
                    pressure.instrument, pressure.lowest, pressure.highest, None)]  # fmt: skip
    for unit in UNITS:
        rows += [
            Channel(f"{unit}_{stem}", stem.rpartition("_")[2],
                    f"{stem.partition('_')[0]} of the {unit}", unit, f"{unit} odometry",
                    -bound, bound, None, standard=False, part=unit)
            for stem, bound in bounds.items()
        ]  # fmt: skip
    return tuple(rows)


def resolved(
    channels: Mapping[str, Series],
) -> tuple[dict[str, Series], dict[str, str], tuple[str, ...]]:
    """Replace what stands in for channels.

    Args:
        channels: by name, of the table and of `stand_ins`.

    Returns:
        Channels of the table alone; metadata; notes.

    Raises:
        StandInError: half a position, or a channel and what stands in for it.
    """
    left = dict(channels)
    notes = _share_pressure(left)
    origin = _first_fix(left)
    metadata: dict[str, str] = {}
    for unit in UNITS:
        if f"{unit}_latitude_rad" in left and origin is not None:
            notes += _place(left, unit, origin)
        left.pop(f"{unit}_altitude_m", None)
    if origin is not None:
        degrees = [math.degrees(angle) for angle in origin]
        metadata[ORIGIN_DEG] = f"{degrees[0]:.9f} {degrees[1]:.9f}"
        notes.append("positions are east and north of the first fix, at latitude"
                     f" {degrees[0]:.6f} deg, longitude {degrees[1]:.6f} deg")  # fmt: skip
    return left, metadata, tuple(notes)


def _share_pressure(left: dict[str, Series]) -> list[str]:
    recorded = [name for name in CIRCUITS if name in left]
    shared = left.pop(ALL_CIRCUITS, None)
    if shared is not None:
        free = [name for name in CIRCUITS if name not in recorded]
        if not free:
            raise StandInError(ALL_CIRCUITS, "all three circuits have a pressure of their own",
                               f"{ALL_CIRCUITS} alone, or the circuits")  # fmt: skip
        left.update(dict.fromkeys(free, shared))
        shown = ", ".join(name.removesuffix("_pa").removeprefix("brake_pressure_") for name in free)
        return [f"one brake pressure is taken for these circuits: {shown}"]
    if len(recorded) == 1:
        return [f"{recorded[0]} is the only brake pressure: the other circuits count as not"
                f" recorded; a pressure that acts on all circuits is mapped as {ALL_CIRCUITS}"]
    return []  # fmt: skip


def _first_fix(left: dict[str, Series]) -> tuple[float, float] | None:
    """Latitude and longitude of the earliest sample; all of it checked."""
    firsts = []
    for unit in UNITS:
        names = [f"{unit}_{stem}" for stem in _STEMS[:2]]
        there = [name for name in names if name in left]
        if len(there) == 1:
            other = next(name for name in names if name not in there)
            raise StandInError(there[0], f"{there[0]} without {other}", "both, or neither")
        if there:
            taken = [f"{unit}_{axis}" for axis in ("x_m", "y_m") if f"{unit}_{axis}" in left]
            if taken:
                raise StandInError(there[0], f"{taken[0]} is mapped, too",
                                   "positions, or latitude and longitude")  # fmt: skip
            latitude, longitude = _fixes(left, unit)
            firsts.append((latitude.time_s[0], latitude.value[0], longitude.value[0]))
    return None if not firsts else (float(min(firsts)[1]), float(min(firsts)[2]))


def _fixes(left: dict[str, Series], unit: str) -> tuple[Series, Series]:
    """Both on the instants of the latitude; a receiver without a fix says 0, 0."""
    latitude, longitude = (left[f"{unit}_{stem}"] for stem in _STEMS[:2])
    turned = np.interp(latitude.time_s, longitude.time_s, np.unwrap(longitude.value))
    there = (latitude.value != 0.0) | (turned != 0.0)
    if not there.any():
        raise StandInError(f"{unit}_latitude_rad", "the receiver never had a fix",
                           "a latitude and longitude other than 0, 0")  # fmt: skip
    times = latitude.time_s[there]
    return Series(times, latitude.value[there]), Series(times, turned[there])


def _place(left: dict[str, Series], unit: str, origin: tuple[float, float]) -> list[str]:
    latitude, longitude = _fixes(left, unit)
    lost = len(left[f"{unit}_latitude_rad"]) - len(latitude)
    heights = left.get(f"{unit}_altitude_m")
    height_m = 0.0 if heights is None else float(np.median(heights.value))
    east, north = east_north_m(latitude.value, longitude.value, height_m, origin)
    for stem in _STEMS[:2]:
        del left[f"{unit}_{stem}"]
    left[f"{unit}_x_m"] = Series(latitude.time_s, east)
    left[f"{unit}_y_m"] = Series(latitude.time_s, north)
    return [f"{unit}: {lost} samples at latitude and longitude 0 are no fix"] if lost else []
