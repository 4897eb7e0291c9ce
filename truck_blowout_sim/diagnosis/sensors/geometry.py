"""Where the instruments sit and where the two units are joined.

Only lengths: no mass, no tire, no equation of motion. Positions of the instruments are read from
the recording's metadata where it states them.

References: metadata sentences of the recording format ("2.420 m behind the steer axle ...").
Known limits: the articulation is taken as a point, which a fifth wheel with slack is not.
Validated with: test/diagnosis/test_sensors_geometry.py.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace

from truck_blowout_sim.recordings import Recording
from truck_blowout_sim.vehicle import Vehicle

Vector = tuple[float, float, float]

_DEFAULT_TRACK_M = 1.9
_BEHIND = re.compile(r"([0-9]+(?:\.[0-9]+)?)\s*m behind the (steer axle|kingpin)")
_ABOVE = re.compile(r"([0-9]+(?:\.[0-9]+)?)\s*m above the road")


@dataclass(frozen=True)
class Geometry:
    """Lengths of the combination that kinematics needs.

    Attributes:
        hitch_behind_steer_m: kingpin behind the steer axle (test truck: 5.50 m, fitted to its
            scale tickets).
        hitch_height_m: fifth-wheel plate above the road.
        tractor_behind_steer_m: tractor instruments behind the steer axle; ``None`` if not stated.
        tractor_height_m: tractor instruments above the road.
        trailer_behind_kingpin_m: trailer instruments behind the kingpin; ``None`` if not stated.
        trailer_height_m: trailer instruments above the road.
        track_m: track of each axle by name (the hub's name without its side).
        driven: names of the driven axles.
        steering_ratio: hand-wheel angle per road-wheel angle.
    """

    hitch_behind_steer_m: float = 5.50
    hitch_height_m: float = 1.20
    tractor_behind_steer_m: float | None = None
    tractor_height_m: float = 0.90
    trailer_behind_kingpin_m: float | None = None
    trailer_height_m: float = 1.20
    track_m: Mapping[str, float] = field(default_factory=dict)
    driven: tuple[str, ...] = ("drive_1", "drive_2")
    steering_ratio: float = 22.0

    @property
    def knows_hitch(self) -> bool:
        """Whether both instruments' positions against the hitch are known."""
        return self.tractor_behind_steer_m is not None and self.trailer_behind_kingpin_m is not None

    @property
    def tractor_to_hitch_m(self) -> Vector:
        """Hitch seen from the tractor's instruments, in the tractor's axes."""
        if self.tractor_behind_steer_m is None:
            raise ValueError("position of the tractor's instruments is not stated")
        forward = self.tractor_behind_steer_m - self.hitch_behind_steer_m
        return forward, 0.0, self.hitch_height_m - self.tractor_height_m

    @property
    def trailer_to_hitch_m(self) -> Vector:
        """Hitch seen from the trailer's instruments, in the trailer's axes."""
        if self.trailer_behind_kingpin_m is None:
            raise ValueError("position of the trailer's instruments is not stated")
        return self.trailer_behind_kingpin_m, 0.0, self.hitch_height_m - self.trailer_height_m

    def hub_left_m(self, hub: str) -> float:
        """Lateral position of a hub, left positive; the name ends in its side."""
        axle, _, side = hub.rpartition("_")
        half = 0.5 * self.track_m.get(axle, _DEFAULT_TRACK_M)
        return half if side == "left" else -half

    def drives(self, hub: str) -> bool:
        """Whether a hub is driven, so that it slips while the truck speeds up or coasts."""
        return hub.rpartition("_")[0] in self.driven


def vehicle_geometry(vehicle: Vehicle) -> Geometry:
    """Lengths as a vehicle file has them.

    Args:
        vehicle: one or two units; a unit without a hitch leaves the hitch unknown.
    """
    axles = vehicle.spec.axles
    tractor, trailer = vehicle.unit_specs["tractor"], vehicle.unit_specs.get("trailer")
    front_m = min(axle.x_m for axle in axles.values() if axle.unit == "tractor")
    track_m = {name: axle.track_m for name, axle in axles.items()}
    driven = tuple(name for name, axle in axles.items() if axle.drive_share > 0.0)
    tractor_m = tractor.base_link.x_m - front_m
    ratio = vehicle.spec.steering.ratio if vehicle.spec.steering else Geometry.steering_ratio
    if tractor.hitch is None or trailer is None or trailer.hitch is None:
        return Geometry(
            tractor_behind_steer_m=tractor_m,
            tractor_height_m=tractor.base_link.z_m,
            track_m=track_m,
            driven=driven,
            steering_ratio=ratio,
        )
    return Geometry(
        hitch_behind_steer_m=tractor.hitch.x_m - front_m,
        hitch_height_m=tractor.hitch.z_m,
        tractor_behind_steer_m=tractor_m,
        tractor_height_m=tractor.base_link.z_m,
        trailer_behind_kingpin_m=trailer.base_link.x_m - trailer.hitch.x_m,
        trailer_height_m=trailer.base_link.z_m,
        track_m=track_m,
        driven=driven,
        steering_ratio=ratio,
    )


def stated_geometry(recordings: Iterable[Recording], base: Geometry | None = None) -> Geometry:
    """Geometry with the instrument positions that the recordings' metadata state.

    Args:
        recordings: the first one that states a position decides.
        base: lengths of the vehicle; the default tractor-semitrailer's if left out.

    Returns:
        ``base`` with stated positions filled in.
    """
    geometry = base or Geometry()
    for recording in reversed(list(recordings)):
        geometry = _with_stated(geometry, recording.metadata)
    return geometry


def _with_stated(geometry: Geometry, metadata: Mapping[str, str]) -> Geometry:
    tractor = metadata.get("tractor_base_link", "")
    trailer = metadata.get("trailer_base_link", "")
    behind_steer, behind_kingpin = _first(_BEHIND, tractor), _first(_BEHIND, trailer)
    tractor_height, trailer_height = _first(_ABOVE, tractor), _first(_ABOVE, trailer)
    if behind_steer is not None:
        geometry = replace(geometry, tractor_behind_steer_m=behind_steer)
    if behind_kingpin is not None:
        geometry = replace(geometry, trailer_behind_kingpin_m=behind_kingpin)
    if tractor_height is not None:
        geometry = replace(geometry, tractor_height_m=tractor_height)
    if trailer_height is not None:
        geometry = replace(geometry, trailer_height_m=trailer_height)
    return geometry


def _first(pattern: re.Pattern[str], text: str) -> float | None:
    found = pattern.search(text)
    return float(found.group(1)) if found else None
