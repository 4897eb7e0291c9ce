"""Where the parts of a vehicle are, in the frames of its units.

x forward, y left, z up from a unit's `base_link`; the vehicle file measures x rearward from the
unit's origin and z from the road.
"""

from __future__ import annotations

from dataclasses import dataclass

from truck_blowout_sim.vehicle.vehicle import Vehicle


@dataclass(frozen=True)
class HubPlace:
    """A wheel end: its unit, the wheel center from that unit's `base_link`, and its tires.

    Attributes:
        hub: name.
        unit: name of the unit it carries.
        steered: turned by the steering.
        x_m, y_m, z_m: wheel center (middle of duals), standing on unloaded tires.
        tires: (name, y from the wheel center, free radius) of each tire.
    """

    hub: str
    unit: str
    steered: bool
    x_m: float
    y_m: float
    z_m: float
    tires: tuple[tuple[str, float, float], ...]


def hub_places(vehicle: Vehicle) -> tuple[HubPlace, ...]:
    """All wheel ends, in the vehicle's order."""
    return tuple(_hub_place(vehicle, hub) for hub in vehicle.hubs)


def hitch_of(vehicle: Vehicle, unit: str) -> tuple[float, float, float]:
    """Fifth wheel or kingpin from the unit's `base_link`, m.

    Raises:
        ValueError: this unit is not coupled to another.
    """
    spec = vehicle.unit_specs[unit]
    if spec.hitch is None:
        raise ValueError(f"{unit} has no hitch")
    return spec.base_link.x_m - spec.hitch.x_m, 0.0, spec.hitch.z_m - spec.base_link.z_m


def behind_m(vehicle: Vehicle, axle: str) -> float:
    """How far an axle stands behind the foremost one of a straight truck, m."""
    origins, at = dict[str, float](), 0.0
    for name, unit in vehicle.unit_specs.items():
        if origins and unit.hitch is not None:
            at -= unit.hitch.x_m
        origins[name] = at
        if unit.hitch is not None:
            at += unit.hitch.x_m
    places = {name: origins[spec.unit] + spec.x_m for name, spec in vehicle.spec.axles.items()}
    return places[axle] - min(places.values())


def _hub_place(vehicle: Vehicle, hub: str) -> HubPlace:
    axle = vehicle.spec.axles[vehicle.axle_of_hub(hub)]
    base = vehicle.unit_specs[axle.unit].base_link
    side = 1.0 if hub.endswith("_left") else -1.0
    names = vehicle.tires_of_hub(hub)
    offsets = (0.0,) if len(names) == 1 else (axle.dual_spacing_m / 2, -axle.dual_spacing_m / 2)
    tires = tuple(
        (name, side * offset_m, vehicle.tire_specs[name].unloaded_radius_m)
        for name, offset_m in zip(names, offsets, strict=True)
    )
    return HubPlace(
        hub=hub,
        unit=axle.unit,
        steered=axle.steered,
        x_m=base.x_m - axle.x_m,
        y_m=side * axle.track_m / 2,
        z_m=max(radius_m for _, _, radius_m in tires) - base.z_m,
        tires=tires,
    )
