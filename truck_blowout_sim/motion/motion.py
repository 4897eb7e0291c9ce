"""The motion of a truck, ready to be drawn: every unit and wheel on one grid of times."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.motion.source import Floats, Source
from truck_blowout_sim.motion.tracks import UnitTrack, unit_tracks
from truck_blowout_sim.motion.wheels import WheelTrack, wheel_tracks
from truck_blowout_sim.recordings import Recording
from truck_blowout_sim.recordings.stray_time import require_span
from truck_blowout_sim.vehicle import Vehicle


@dataclass(frozen=True, eq=False)
class Motion:
    """Where every part of a truck was.

    Attributes:
        times_s: instants on the recording's clock, evenly spaced.
        units: pose of each unit, front to rear.
        wheels: each hub.
        assumptions: what was not recorded and how it was filled, a sentence each.
    """

    times_s: Floats
    units: Mapping[str, UnitTrack]
    wheels: Mapping[str, WheelTrack]
    assumptions: tuple[str, ...]


def motion_of(recording: Recording, vehicle: Vehicle, *, rate_hz: float = 50.0) -> Motion:
    """Read the motion of a vehicle from a recording of any completeness.

    Args:
        recording: measured or simulated; what it lacks is filled from the vehicle and said.
        vehicle: what is drawn.
        rate_hz: instants a second.

    Raises:
        InputError: nothing was recorded, or more than a day; or a blown tire is none of the
            vehicle's.
    """
    _check(recording, vehicle)
    require_span(recording)
    n = max(math.floor((recording.end_s - recording.start_s) * rate_hz + 1e-6), 1) + 1
    source = Source(recording, recording.start_s + np.arange(n) / rate_hz)
    units = unit_tracks(source, vehicle)
    return Motion(source.times_s, units, wheel_tracks(source, vehicle), tuple(source.assumptions))


def _check(recording: Recording, vehicle: Vehicle) -> None:
    if not any(len(series) for series in recording.channels.values()):
        raise InputError("holds no samples", file=recording.name, expected="a recorded channel")
    for event in recording.blowouts:
        for tire in event.tires:
            if tire not in vehicle.tires:
                raise InputError(f"blowout of {tire!r}", file=recording.name,
                                 expected=f"a tire of {vehicle.name}: {', '.join(vehicle.tires)}")
