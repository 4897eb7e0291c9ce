"""Whether the anti-lock control of the sheet is at work: a wheel that stands shows that it is not.

Anti-lock control that works lets no wheel it senses stand for longer than a moment. Where a
recording shows one that does, under the brake and on a fast vehicle, the control is broken or was
never fitted; the model then goes without it, or else no grip of the road would explain the run.

References: FMVSS 121 (49 CFR 571.121) S5.3.1: above 20 mph, a controlled wheel may lock for a
second at most. (One wheel of an axle may be without control, and lock for longer: a wheel without a
sensor is not asked.)
Known limits: the whole vehicle is taken to have it or not; what no recorded wheel tells stays as
the sheet has it; a wheel on a lost tire tells nothing.
Validated with: test/diagnosis/test_antilock.py.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from truck_blowout_sim.diagnosis.case.trust import BRAKES_ON_PA
from truck_blowout_sim.diagnosis.sensors.hubs import TURNS_RADPS
from truck_blowout_sim.recordings import Recording
from truck_blowout_sim.recordings.stretches import unbroken
from truck_blowout_sim.vehicle import Packed, Vehicle
from truck_blowout_sim.vehicle.schema.controls import ABS_MODES
from truck_blowout_sim.vehicle.vehicle import hubs_of_axle

MODE = "abs.mode"
_OFF, _EACH_WHEEL = (float(ABS_MODES.index(mode)) for mode in ("off", "slip_threshold"))
_FAST_MPS = 8.94  # 20 mph
_MOMENT_S = 1.0


@dataclass(frozen=True)
class Lockup:
    """A wheel that stood while it was braked on a fast vehicle.

    Attributes:
        recording: its name; ``hub``: of the wheel.
        start_s, end_s: from when to when it stood.
        speed_mps: of the vehicle when it began.
    """

    recording: str
    hub: str
    start_s: float
    end_s: float
    speed_mps: float

    @property
    def sentence(self) -> str:
        """For a driver."""
        return (f"The anti-lock control does not work: in {self.recording}, wheel {self.hub} stood "
                f"for {self.end_s - self.start_s:.1f} s while it was braked, from "
                f"{self.speed_mps:.0f} m/s on; the model goes without the control.")


def as_braked(packed: Packed, recordings: Sequence[Recording]) -> tuple[Packed, Lockup | None]:
    """The truck without its anti-lock control, if a recording shows that it has none at work.

    Args:
        packed: the truck of the sheet.
        recordings: what is fitted.

    Returns:
        The truck, and the longest lockup, None where none is seen or the sheet has no control.
    """
    if packed[MODE] == _OFF:
        return packed, None
    seen = [one for recording in recordings for one in lockups(packed, recording)]
    if not seen:
        return packed, None
    return packed.unchecked({MODE: _OFF}), max(seen, key=lambda one: one.end_s - one.start_s)


def lockups(packed: Packed, recording: Recording) -> Iterator[Lockup]:
    """Wheels with a sensor of the control that stand for longer than a moment."""
    vehicle = packed.vehicle
    lost = {vehicle.hub_of_tire(tire) for event in recording.blowouts for tire in event.tires}
    for axle in sensed_axles(vehicle, each=packed[MODE] == _EACH_WHEEL):
        for hub in hubs_of_axle(axle):
            found = None if hub in lost else _longest(vehicle, recording, axle, hub)
            if found is not None:
                yield found


def sensed_axles(vehicle: Vehicle, *, each: bool) -> list[str]:
    """Axles whose wheels have sensors: of a group the first, of a trailer's the last."""
    if each:
        return list(vehicle.axles)
    groups: dict[str, list[str]] = {}
    for axle in vehicle.axles:
        groups.setdefault(vehicle.spec.axles[axle].circuit, []).append(axle)
    return [axle for circuit, group in groups.items()
            for axle in {"steer": group, "drive": group[:1]}.get(circuit, group[-1:])]


def _longest(vehicle: Vehicle, recording: Recording, axle: str, hub: str) -> Lockup | None:
    """The longest time that a wheel stands, if it turned before and the brake is on."""
    names = (f"hub_speed_{hub}_radps", f"{vehicle.units[0]}_vx_mps",
             f"brake_pressure_{vehicle.spec.axles[axle].circuit}_pa")
    if any(name not in recording or not len(recording[name]) for name in names):
        return None
    spin = recording[names[0]]
    speed, pressure = (recording[name].at(spin.time_s) for name in names[1:])
    turned = np.maximum.accumulate(np.abs(spin.value)) > TURNS_RADPS
    stands = ((np.abs(spin.value) < TURNS_RADPS) & turned & (speed > _FAST_MPS)
              & (pressure > BRAKES_ON_PA))
    times = [(float(spin.time_s[first]), float(spin.time_s[end - 1]), first)
             for first, end in unbroken(stands)]
    if not times:
        return None
    start_s, end_s, first = max(times, key=lambda one: one[1] - one[0])
    if end_s - start_s <= _MOMENT_S:
        return None
    return Lockup(recording.name, hub, start_s, end_s, float(speed[first]))
