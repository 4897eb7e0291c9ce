"""The robot description (URDF) of a vehicle: links with shapes and inertias, joints of `model`.

Known limits: a unit's sprung mass with its payload is one link; an axle's mass is shared evenly
between its wheel ends, and a wheel end turns about its axle with the inertia that the vehicle file
gives and, across it, with that of a solid disc of its mass.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from truck_blowout_sim.display.model import ROOT, Joint, joints_of, link_of
from truck_blowout_sim.vehicle import Vehicle
from truck_blowout_sim.vehicle.masses import unit_mass
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
        f'  <link name="{ROOT}"/>',
    ]  # fmt: skip
    drawn = {ROOT}
    for unit in vehicle.units:
        lines += _body(link_of(unit), unit, vehicle, hubs)
        drawn.add(link_of(unit))
    for hub in hubs:
        lines += _wheels(vehicle, hub)
        drawn |= {hub.hub, *(tire for tire, _, _ in hub.tires)}
    joints = joints_of(vehicle)
    lines += [f'  <link name="{j.child}"/>' for j in joints if j.child not in drawn]
    for joint in joints:
        lines += _joint(joint)
    return "\n".join([*lines, "</robot>", ""])


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
    yield from _sprung_inertia(vehicle, unit)
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


def _sprung_inertia(vehicle: Vehicle, unit: str) -> Iterator[str]:
    spec = vehicle.unit_specs[unit]
    mass = unit_mass(spec)
    # URDF wants entries of the tensor: the products enter it with a minus
    at = (spec.base_link.x_m - mass.x_m, 0.0, mass.z_m - spec.base_link.z_m)
    yield from _inertial(mass.mass_kg, at, (mass.ixx_kgm2, mass.iyy_kgm2, mass.izz_kgm2),
                         -mass.ixz_kgm2)  # fmt: skip


def _inertial(
    mass_kg: float,
    at_m: tuple[float, float, float],
    moments_kgm2: tuple[float, float, float],
    ixz_kgm2: float = 0.0,
) -> Iterator[str]:
    ixx, iyy, izz = moments_kgm2
    yield "    <inertial>"
    yield f'      <origin xyz="{at_m[0]:.4f} {at_m[1]:.4f} {at_m[2]:.4f}"/>'
    yield f'      <mass value="{mass_kg:.6g}"/>'
    yield (f'      <inertia ixx="{ixx:.6g}" iyy="{iyy:.6g}" izz="{izz:.6g}" ixy="0"'
           f' ixz="{ixz_kgm2:.6g}" iyz="0"/>')  # fmt: skip
    yield "    </inertial>"


def _wheels(vehicle: Vehicle, hub: HubPlace) -> Iterator[str]:
    """A wheel end: its mass at the hub, its shape at the hub or, for duals, at each tire."""
    axle = vehicle.spec.axles[vehicle.axle_of_hub(hub.hub)]
    mass_kg, spin_kgm2 = axle.mass_kg / 2.0, axle.spin_inertia_kgm2
    across_kgm2 = spin_kgm2 / 2.0 + mass_kg * _TIRE_WIDTH_M**2 / 12.0  # a solid disc
    single = len(hub.tires) == 1
    yield f'  <link name="{hub.hub}">'
    if single:
        yield from _shape(hub.tires[0][2])
    yield from _inertial(mass_kg, (0.0, 0.0, 0.0), (across_kgm2, spin_kgm2, across_kgm2))
    yield "  </link>"
    if not single:
        for tire, _, radius_m in hub.tires:
            yield f'  <link name="{tire}">'
            yield from _shape(radius_m)
            yield "  </link>"


def _shape(radius_m: float) -> Iterator[str]:
    shape = f'<cylinder radius="{radius_m:.4f}" length="{_TIRE_WIDTH_M}"/>'
    yield "    <visual>"
    yield '      <origin xyz="0 0 0" rpy="1.5707963 0 0"/>'
    yield f"      <geometry>{shape}</geometry>"
    yield '      <material name="tire"/>'
    yield "    </visual>"


def _joint(joint: Joint) -> Iterator[str]:
    yield f'  <joint name="{joint.name}" type="{joint.kind}">'
    yield f'    <parent link="{joint.parent}"/>'
    yield f'    <child link="{joint.child}"/>'
    yield f'    <origin xyz="{joint.at[0]:.4f} {joint.at[1]:.4f} {joint.at[2]:.4f}"/>'
    if joint.kind != "fixed":
        yield '    <axis xyz="{:g} {:g} {:g}"/>'.format(*joint.axis)
    if joint.kind == "prismatic":
        yield '    <limit lower="-0.6" upper="0.6" effort="0" velocity="10"/>'
    yield "  </joint>"
