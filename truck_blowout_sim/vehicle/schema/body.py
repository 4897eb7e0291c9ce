"""Units: the sprung bodies, their payload and what joins them.

Positions are given as sources print them: x rearward from the unit's origin (the steer axle of a
tractor, the kingpin of a trailer), z above the road. Bodies and payload stand on the center line.
"""

# ruff: noqa: RUF009 (section() is a dataclasses.field)
from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from truck_blowout_sim.vehicle.fields import (
    at_least_zero,
    fraction,
    number,
    positive,
    section,
    sections,
)


@dataclass(frozen=True, kw_only=True)
class BodySpec:
    """A sprung mass without its payload; inertias about its own center of gravity."""

    mass_kg: float = positive("sprung mass, crew included")
    x_m: float = number("center of gravity behind the origin")
    z_m: float = positive("center of gravity above the road")
    ixx_kgm2: float = positive("roll inertia")
    iyy_kgm2: float = positive("pitch inertia")
    izz_kgm2: float = positive("yaw inertia")
    ixz_kgm2: float = number("product of inertia: integral of x z dm, x forward, z up", default=0.0)


@dataclass(frozen=True, kw_only=True)
class PayloadSpec:
    """A box of even density."""

    mass_kg: float = positive("mass of the box")
    x_m: float = number("center of the box behind the origin")
    z_m: float = positive("center of the box above the road")
    length_m: float = at_least_zero("length of the box")
    width_m: float = at_least_zero("width of the box")
    height_m: float = at_least_zero("height of the box")


@dataclass(frozen=True, kw_only=True)
class FrameSpec:
    """How far the frame reaches, and how it twists."""

    front_x_m: float = number("front end behind the origin (negative: ahead of it)")
    rear_x_m: float = number("rear end behind the origin")
    torsion_nmprad: float = positive("torsion from the origin to fifth wheel or axles")
    torsion_damping_s: float = positive("time constant of the twist")
    torsion_height_m: float = positive("axis of the twist above the road")
    torsion_front_share: float = fraction("share of the compliance ahead of the body's mass")


@dataclass(frozen=True, kw_only=True)
class PointSpec:
    """A point on the center line."""

    x_m: float = number("behind the origin")
    z_m: float = positive("above the road")


@dataclass(frozen=True, kw_only=True)
class AirSpec:
    """What air does to a unit."""

    drag_area_m2: float = at_least_zero("drag coefficient times frontal area")
    drag_z_m: float = at_least_zero("height of the drag force above the road")
    side_area_m2: float = at_least_zero("side force area per radian of air angle")
    side_x_m: float = number("line of action of the side force behind the origin")
    side_z_m: float = at_least_zero("height of the side force above the road")


@dataclass(frozen=True, kw_only=True)
class UnitSpec:
    """A tractor, a trailer, a car."""

    body: BodySpec = section(BodySpec, "sprung mass")
    frame: FrameSpec = section(FrameSpec, "frame")
    base_link: PointSpec = section(PointSpec, "where the instruments sit and outputs are given")
    air: AirSpec = section(AirSpec, "aerodynamics")
    hitch: PointSpec | None = section(PointSpec, "fifth wheel or kingpin", optional=True)
    payload: Mapping[str, PayloadSpec] = sections(PayloadSpec, "payload blocks")


@dataclass(frozen=True, kw_only=True)
class FifthWheelSpec:
    """Fifth wheel between tractor and trailer."""

    stiffness_xy_npm: float = positive("stiffness in the plane")
    damping_xy_nspm: float = at_least_zero("damping in the plane")
    stiffness_z_npm: float = positive("vertical stiffness")
    damping_z_nspm: float = at_least_zero("vertical damping")
    roll_stiffness_nmprad: float = at_least_zero("roll stiffness")
    roll_damping_nmsprad: float = at_least_zero("roll damping")
    roll_lash_rad: float = at_least_zero("free roll to either side, once the plate lifts")
    plate_half_width_m: float = positive("half width of the plate")
    yaw_friction_nm: float = at_least_zero("friction moment in yaw")
    yaw_friction_transition_rad: float = positive("articulation over which friction builds up")
