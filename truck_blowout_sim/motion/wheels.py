"""What each wheel end did: steer and spin of the hub, height, air and forces of its tires.

A loaded radius that was not recorded is that of the tire at rest; of a blown tire, of the rim.
Where the pressure was not recorded, air leaves within the half second of the 2013 test.

References: thesis L665 (half a second); the radial law of physics/tires/tire.py, without damping.
Known limits: a twin beside a flat one carries the wheel, its own deflection stays as at rest.
Validated with: test/motion/test_motion.py.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.motion.source import Floats, Source
from truck_blowout_sim.recordings.units import GRAVITY_MPS2
from truck_blowout_sim.vehicle import Vehicle
from truck_blowout_sim.vehicle.statics import static_loads

_DEFLATION_S = 0.5  # thesis L665
_FORCES = ("fx", "fy", "fz")


@dataclass(frozen=True, eq=False)
class WheelTrack:
    """One hub over time.

    Attributes:
        steer_rad: road-wheel angle, left positive.
        spin_rad: angle the hub has turned, forward positive.
        height_m: hub above the road.
        air: part of the gauge pressure left, by tire; 0 flat, 1 as set.
        forces_n: along and across the wheel and upward, shape (3, n), by tire; only recorded ones.
    """

    steer_rad: Floats
    spin_rad: Floats
    height_m: Floats
    air: Mapping[str, Floats]
    forces_n: Mapping[str, Floats]


def wheel_tracks(source: Source, vehicle: Vehicle) -> dict[str, WheelTrack]:
    """The track of every hub."""
    rest = _resting_radii(source, vehicle)
    tracks = {}
    for hub in vehicle.hubs:
        tires = vehicle.tires_of_hub(hub)
        air = {tire: _air(source, vehicle, tire) for tire in tires}
        height = _height(source, vehicle, tires, air, rest)
        forces = {tire: found for tire in tires if (found := _forces(source, tire)) is not None}
        tracks[hub] = WheelTrack(_steer(source, vehicle, hub), _spin(source, hub, height), height,
                                 air, forces)
    if not any(track.forces_n for track in tracks.values()):
        source.assume("tire forces: not drawn, none was recorded")
    return tracks


def _steer(source: Source, vehicle: Vehicle, hub: str) -> Floats:
    if not vehicle.spec.axles[vehicle.axle_of_hub(hub)].steered:
        return np.zeros(source.times_s.size)
    steer = source.get(f"{hub}_steer_rad")
    if steer is not None:
        return steer
    wheel, steering = source.get("steering_wheel_angle_rad"), vehicle.spec.steering
    if wheel is None or steering is None:
        source.assume("road wheels: straight, no steering was recorded")
        return np.zeros(source.times_s.size)
    source.assume("road wheels: the hand wheel's angle over the steering ratio")
    return wheel / steering.ratio


def _spin(source: Source, hub: str, height: Floats) -> Floats:
    angle = source.angle(f"hub_spin_angle_{hub}_rad")
    if angle is not None:
        return angle
    speed = source.get(f"hub_speed_{hub}_radps")
    if speed is None:
        forward, _ = source.or_constant("tractor_vx_mps", 0.0)
        source.assume("wheel spin: rolling at the truck's speed where a hub speed is missing")
        speed = forward / height
    return source.integral(speed)


def _air(source: Source, vehicle: Vehicle, tire: str) -> Floats:
    """Part of the pressure left."""
    recorded = source.get(f"tire_pressure_{tire}_pa")
    if recorded is not None:
        full = max(float(recorded.max()), 0.5 * vehicle.tire_specs[tire].pressure_pa, 1.0)
        return np.clip(recorded / full, 0.0, 1.0)
    bursts = [event.time_s for event in source.recording.blowouts if tire in event.tires]
    if not bursts:
        return np.ones(source.times_s.size)
    source.assume("air of the blown tire: gone in half a second, its pressure was not recorded")
    return 1.0 - np.clip((source.times_s - min(bursts)) / _DEFLATION_S, 0.0, 1.0)


def _resting_radii(source: Source, vehicle: Vehicle) -> dict[str, float]:
    """Hub height of each tire at rest on the level."""
    try:
        loads = static_loads(vehicle, GRAVITY_MPS2).road_n
    except (ValueError, InputError):
        source.assume("axle loads at rest: unknown, tires are drawn at their free radius")
        loads = {}
    radii = {}
    for tire in vehicle.tires:
        hub, spec = vehicle.hub_of_tire(tire), vehicle.tire_specs[tire]
        share = loads.get(vehicle.axle_of_hub(hub), 0.0) / 2 / len(vehicle.tires_of_hub(hub))
        stiffness = spec.stiffness_npm + spec.stiffness_npmppa * spec.pressure_pa
        radii[tire] = spec.unloaded_radius_m - (share / stiffness if stiffness > 0.0 else 0.0)
    return radii


def _height(source: Source, vehicle: Vehicle, tires: tuple[str, ...], air: Mapping[str, Floats],
            rest: Mapping[str, float]) -> Floats:
    recorded = [source.get(f"tire_loaded_radius_{tire}_m") for tire in tires]
    known = [radius for radius in recorded if radius is not None]
    if known:
        return np.max(known, axis=0)
    source.assume("height of the hubs: that at rest, of a blown tire that of the rim")
    flat = {tire: vehicle.rim(tire).rim_contact_radius_m for tire in tires}
    return np.max([flat[tire] + (rest[tire] - flat[tire]) * air[tire] for tire in tires], axis=0)


def _forces(source: Source, tire: str) -> Floats | None:
    parts = [source.get(f"tire_{force}_{tire}_n") for force in _FORCES]
    if all(part is None for part in parts):
        return None
    zero = np.zeros(source.times_s.size)
    return np.stack([zero if part is None else part for part in parts])
