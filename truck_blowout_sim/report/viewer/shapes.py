"""What a vehicle looks like, as plain data for the page: boxes of the sheet, and drawn bodies.

Measured by the vehicle file: frames, payload, hitch, hubs, radii. Drawn by judgement, and said so
on the page: the outline of cab or car, the width of tires, the rim.
"""

from __future__ import annotations

from typing import Any

from truck_blowout_sim.vehicle import Vehicle
from truck_blowout_sim.vehicle.places import HubPlace, hub_places
from truck_blowout_sim.vehicle.schema.body import PayloadSpec, UnitSpec

_TIRE_WIDTH_OF_RADIUS = 0.56  # 11R22.5: 0.28 m at a free radius of 0.526 m
_RIM_OF_RADIUS = 0.56  # 22.5 in of 1,041 mm
_TWIN_GAP = 0.86  # share of the spacing of twin tires that one fills
_CAR_WHEELBASE_M = 3.6

DRAWN = ("the outline of cab and frame, the width of tires and their rims are drawn, not measured;"
         " lengths, tracks, radii, hitch and payload are those of the vehicle file")


def vehicle_shape(vehicle: Vehicle) -> dict[str, Any]:
    """Units and hubs in their own frames (x forward, y left, z up from ``base_link``), m."""
    places = hub_places(vehicle)
    units = {name: _unit(vehicle, name, spec, places)
             for name, spec in vehicle.unit_specs.items()}
    return {"name": vehicle.name, "title": vehicle.title, "units": units,
            "hubs": [_hub(vehicle, place) for place in places]}


def _unit(vehicle: Vehicle, name: str, spec: UnitSpec, places: tuple[HubPlace, ...]
          ) -> dict[str, Any]:
    base = spec.base_link
    mine = [place for place in places if place.unit == name]
    outer = max((abs(y) + place.y_m for place in mine if place.y_m > 0
                 for _, y, _ in place.tires), default=1.0)
    hitch = spec.hitch and [base.x_m - spec.hitch.x_m, spec.hitch.z_m - base.z_m]
    return {
        "kind": _kind(vehicle, name, spec),
        "ground": -base.z_m,
        "front": base.x_m - spec.frame.front_x_m,
        "rear": base.x_m - spec.frame.rear_x_m,
        "halfWidth": outer + 0.14,
        "hitch": hitch,
        "axles": sorted({place.x_m for place in mine}, reverse=True),
        "wheelRadius": max((r for place in mine for _, _, r in place.tires), default=0.5),
        "payload": [_box(block, base.x_m, base.z_m) for block in spec.payload.values()],
    }


def _kind(vehicle: Vehicle, name: str, spec: UnitSpec) -> str:
    """Which outline is drawn."""
    if name != vehicle.units[0]:
        return "flatbed"
    axles = [axle.x_m for axle in vehicle.spec.axles.values() if axle.unit == name]
    if spec.hitch is None and max(axles) - min(axles) < _CAR_WHEELBASE_M:
        return "car"
    return "tractor" if spec.hitch is not None else "rigid"


def _box(block: PayloadSpec, base_x_m: float, base_z_m: float) -> list[float]:
    """Center and size of a payload block."""
    return [base_x_m - block.x_m, block.z_m - base_z_m, block.length_m, block.width_m,
            block.height_m]


def _hub(vehicle: Vehicle, place: HubPlace) -> dict[str, Any]:
    spacing = vehicle.spec.axles[vehicle.axle_of_hub(place.hub)].dual_spacing_m
    tires = []
    for name, y, radius in place.tires:
        width = _TIRE_WIDTH_OF_RADIUS * radius
        if len(place.tires) > 1:
            width = min(width, _TWIN_GAP * spacing)
        tires.append({"name": name, "y": y, "radius": radius, "width": width,
                      "rim": _RIM_OF_RADIUS * radius})
    return {"name": place.hub, "unit": place.unit, "x": place.x_m, "y": place.y_m, "tires": tires}
