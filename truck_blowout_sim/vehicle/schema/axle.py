"""Axles, their suspension, brakes and wheel ends."""

# ruff: noqa: RUF009 (section() is a dataclasses.field)
from __future__ import annotations

from dataclasses import dataclass

from truck_blowout_sim.vehicle.fields import (
    at_least_zero,
    choice,
    fraction,
    number,
    positive,
    section,
    switch,
    text,
)

CIRCUITS = ("steer", "drive", "trailer")
UNITS = ("tractor", "trailer")


@dataclass(frozen=True, kw_only=True)
class SuspensionSpec:
    """Springs, dampers and linkage of one axle; rates are per side, at the spring."""

    spring_npm: float = positive("spring rate")
    damping_nspm: float = at_least_zero("damper rate")
    friction_n: float = at_least_zero("Coulomb friction to either direction")
    friction_transition_m: float = positive("travel over which friction turns over")
    aux_roll_nmprad: float = at_least_zero("auxiliary roll stiffness of the axle")
    jounce_m: float = positive("travel to the upper stop")
    rebound_m: float = positive("travel to the lower stop")
    stop_npm: float = at_least_zero("rate of the stops")
    equalizer_m: float = at_least_zero("travel over which the axles of a tandem share their load")
    roll_steer: float = number("axle steer per body roll, positive: understeer")
    roll_centre_height_m: float = at_least_zero("roll center above the road")


@dataclass(frozen=True, kw_only=True)
class BrakeSpec:
    """Brake torque of one wheel end: linear * x - quadratic * x^2, x chamber minus push-out."""

    linear_nmppa: float = at_least_zero("torque per pressure")
    quadratic_nmppa2: float = at_least_zero("loss of torque per pressure squared")
    pushout_pa: float = at_least_zero("chamber pressure at which the shoes touch")


@dataclass(frozen=True, kw_only=True)
class AxleSpec:
    """A solid axle with one hub a side."""

    unit: str = choice("the unit it carries", UNITS)
    circuit: str = choice("brake circuit; axles of one circuit share their load", CIRCUITS)
    x_m: float = number("behind the unit's origin")
    mass_kg: float = positive("unsprung mass with wheels")
    ixx_kgm2: float = positive("roll inertia")
    izz_kgm2: float = positive("yaw inertia")
    track_m: float = positive("between the wheel centers, duals at their middle")
    spring_spacing_m: float = positive("between the springs")
    suspension: SuspensionSpec = section(SuspensionSpec, "suspension")
    brake: BrakeSpec | None = section(BrakeSpec, "brakes; none: an axle without", optional=True)
    spin_inertia_kgm2: float = positive("spin inertia of one hub with its wheels")
    dual_spacing_m: float = at_least_zero("between twin tires; 0: single tires", default=0.0)
    steered: bool = switch("turned by the steering", default=False)
    drive_share: float = fraction("share of the drive force at each hub", default=0.0)
    toe_in_rad: float = number("toe-in of each wheel", default=0.0)
    camber_left_rad: float = number("static camber, positive: top outward", default=0.0)
    camber_right_rad: float = number("static camber, positive: top outward", default=0.0)
    equalized_with: str = text("the other axle of an equalised tandem", default="")
