"""A robot description from a vehicle file: `ros2 run truck_blowout_sim urdf [VEHICLE] [-o FILE]`.

The root is `tractor/base_link`, which the simulator's /tf places in `map`. The trailer hangs on the
joints `articulation`, `trailer_pitch`, `trailer_roll`; its link is `trailer/chassis`, not
`trailer/base_link`: /tf already gives that frame a parent, and a frame has one.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.nodes.simulator_parameters import DEFAULT_VEHICLE
from truck_blowout_sim.vehicle import Vehicle, load_vehicle
from truck_blowout_sim.vehicle.places import HubPlace, hitch_of, hub_places

_COLORS = {"tractor": "0.15 0.30 0.55 1", "trailer": "0.80 0.80 0.78 1", "tire": "0.08 0.08 0.08 1"}
_BODY_HEIGHT_M = {"tractor": 2.6, "trailer": 2.7}
_BODY_WIDTH_M = 2.5
_TIRE_WIDTH_M = 0.28


def urdf_of(vehicle: Vehicle) -> str:
    """The robot description as XML text."""
    hubs = hub_places(vehicle)
    lines = [
        '<?xml version="1.0"?>',
        f"<!-- Written from the vehicle file {vehicle.name}; do not edit. -->",
        f'<robot name="{vehicle.name}">',
        *(f'  <material name="{name}"><color rgba="{rgba}"/></material>'
          for name, rgba in _COLORS.items()),
        *_body("tractor/base_link", "tractor", vehicle, hubs),
    ]  # fmt: skip
    if len(vehicle.units) > 1:
        lines += _trailer(vehicle, hubs)
    for hub in hubs:
        lines += _wheel_end(hub)
    return "\n".join([*lines, "</robot>", ""])


def main(arguments: Sequence[str] | None = None) -> int:
    """Entry point."""
    words = list(sys.argv[1:] if arguments is None else arguments)
    target = None
    if "-o" in words[:-1]:
        at = words.index("-o")
        target = Path(words[at + 1])
        del words[at : at + 2]
    try:
        text = urdf_of(load_vehicle(words[0] if words else DEFAULT_VEHICLE))
    except InputError as error:
        print(f"urdf: {error}", file=sys.stderr)
        return 2
    if target is None:
        sys.stdout.write(text)
    else:
        target.write_text(text, encoding="utf-8")
    return 0


def link_of(unit: str) -> str:
    """Link that carries the axles of a unit."""
    return "tractor/base_link" if unit == "tractor" else f"{unit}/chassis"


def _body(link: str, unit: str, vehicle: Vehicle, hubs: Sequence[HubPlace]) -> Iterator[str]:
    axles_m = [hub.x_m for hub in hubs if hub.unit == unit]
    ends_m = [*axles_m, *([hitch_of(vehicle, unit)[0]] if len(vehicle.units) > 1 else [])]
    front_m, rear_m = max(ends_m) + 0.9, min(ends_m) - 0.9
    if unit == "tractor":
        # the cab only; the frame behind it stays low, so that the trailer is seen
        rear_m = max(rear_m, front_m - 3.2)
    ground_m = -vehicle.unit_specs[unit].base_link.z_m
    height_m = _BODY_HEIGHT_M[unit] if len(vehicle.units) > 1 else 1.0
    bottom_m = ground_m + (0.9 if unit == "tractor" else 1.3) * min(1.0, height_m / 2)
    yield f'  <link name="{link}">'
    yield from _box(
        (front_m + rear_m) / 2, bottom_m + height_m / 2, front_m - rear_m, height_m, unit
    )
    if unit == "tractor":
        yield from _box(sum(ends_m) / len(ends_m), ground_m + 0.8, max(ends_m) - min(ends_m),
                        0.25, unit, width_m=1.0)  # fmt: skip
    yield "  </link>"


def _box(
    x_m: float, z_m: float, length_m: float, height_m: float, color: str,
    *, width_m: float = _BODY_WIDTH_M,
) -> Iterator[str]:  # fmt: skip
    yield "    <visual>"
    yield f'      <origin xyz="{x_m:.4f} 0 {z_m:.4f}"/>'
    yield f'      <geometry><box size="{length_m:.4f} {width_m:.4f} {height_m:.4f}"/></geometry>'
    yield f'      <material name="{color}"/>'
    yield "    </visual>"


def _trailer(vehicle: Vehicle, hubs: Sequence[HubPlace]) -> Iterator[str]:
    fifth_wheel, kingpin = hitch_of(vehicle, "tractor"), hitch_of(vehicle, "trailer")
    yield '  <link name="trailer/turntable"/>'
    yield '  <link name="trailer/rocker"/>'
    yield '  <link name="trailer/coupler"/>'
    yield from _joint("articulation", "continuous", "tractor/base_link", "trailer/turntable",
                      fifth_wheel, "0 0 1")  # fmt: skip
    yield from _joint("trailer_pitch", "continuous", "trailer/turntable", "trailer/rocker",
                      (0.0, 0.0, 0.0), "0 1 0")  # fmt: skip
    yield from _joint("trailer_roll", "continuous", "trailer/rocker", "trailer/coupler",
                      (0.0, 0.0, 0.0), "1 0 0")  # fmt: skip
    yield from _body("trailer/chassis", "trailer", vehicle, hubs)
    back = (-kingpin[0], -kingpin[1], -kingpin[2])
    yield from _joint("kingpin", "fixed", "trailer/coupler", "trailer/chassis", back)


def _wheel_end(hub: HubPlace) -> Iterator[str]:
    carrier = f"{hub.hub}/carrier"
    yield f'  <link name="{carrier}"/>'
    yield from _joint(f"{hub.hub}_travel", "prismatic", link_of(hub.unit), carrier,
                      (hub.x_m, hub.y_m, hub.z_m), "0 0 1")  # fmt: skip
    parent = carrier
    if hub.steered:
        parent = f"{hub.hub}/knuckle"
        yield f'  <link name="{parent}"/>'
        yield from _joint(f"{hub.hub}_steer", "continuous", carrier, parent,
                          (0.0, 0.0, 0.0), "0 0 1")  # fmt: skip
    if len(hub.tires) == 1:
        yield from _tire(hub.hub, hub.tires[0][2])
    else:
        yield f'  <link name="{hub.hub}"/>'
        for tire, y_m, radius_m in hub.tires:
            yield from _tire(tire, radius_m)
            yield from _joint(f"{tire}_seat", "fixed", hub.hub, tire, (0.0, y_m, 0.0))
    yield from _joint(f"{hub.hub}_spin", "continuous", parent, hub.hub, (0.0, 0.0, 0.0), "0 1 0")


def _tire(link: str, radius_m: float) -> Iterator[str]:
    shape = f'<cylinder radius="{radius_m:.4f}" length="{_TIRE_WIDTH_M}"/>'
    yield f'  <link name="{link}">'
    yield "    <visual>"
    yield '      <origin xyz="0 0 0" rpy="1.5707963 0 0"/>'
    yield f"      <geometry>{shape}</geometry>"
    yield '      <material name="tire"/>'
    yield "    </visual>"
    yield "  </link>"


def _joint(
    name: str, kind: str, parent: str, child: str, at: tuple[float, float, float], axis: str = ""
) -> Iterator[str]:
    yield f'  <joint name="{name}" type="{kind}">'
    yield f'    <parent link="{parent}"/>'
    yield f'    <child link="{child}"/>'
    yield f'    <origin xyz="{at[0]:.4f} {at[1]:.4f} {at[2]:.4f}"/>'
    if axis:
        yield f'    <axis xyz="{axis}"/>'
    if kind == "prismatic":
        yield '    <limit lower="-0.6" upper="0.6" effort="0" velocity="10"/>'
    yield "  </joint>"


if __name__ == "__main__":
    raise SystemExit(main())
