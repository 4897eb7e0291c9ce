"""Steering, driveline and brake control."""

# ruff: noqa: RUF009 (section() is a dataclasses.field)
from __future__ import annotations

import math
from dataclasses import dataclass

from truck_blowout_sim.vehicle.fields import (
    at_least_zero,
    choice,
    fraction,
    number,
    positive,
    section,
    switch,
)

ABS_MODES = ("off", "slip_threshold", "tractor_4s4m_trailer_2s1m")


@dataclass(frozen=True, kw_only=True)
class SteeringSpec:
    """Hand wheel to road wheels."""

    ratio: float = positive("hand-wheel angle per mean road-wheel angle")
    offset_rad: float = number("hand-wheel reading with the gear straight", default=0.0)
    ratio_curve_prad2: float = number(
        "the road wheels turn (1 + curve angle^2) times as far as the ratio says",
        low=-1.0, high=10.0, default=0.0,
    )
    lag_s: float = at_least_zero("first-order lag between hand wheel and gear", default=0.0)
    compliant: bool = switch("false: road wheels follow the hand wheel exactly", default=True)
    stiffness_nmprad: float = positive(
        "kingpin moment of both wheels per mean road-wheel angle, hand wheel held"
    )
    lash_rad: float = at_least_zero("total free play at the hand wheel")
    damping_nmsprad: float = at_least_zero("damping about the kingpins")
    friction_nm: float = at_least_zero("Coulomb friction about the kingpins, both wheels")
    friction_transition_rad: float = positive("angle over which friction turns over")
    inertia_kgm2: float = positive("both wheels about their kingpins")
    ackermann_fraction: float = fraction("0: wheels stay parallel, 1: they meet at one center")
    kingpin_inclination_rad: float = number("kingpin leaning inward at the top")
    caster_rad: float = number("kingpin leaning rearward at the top")
    kingpin_offset_m: float = number("wheel plane to kingpin axis at spindle height")


@dataclass(frozen=True, kw_only=True)
class DrivelineSpec:
    """Engine and driveline as the driven hubs feel them."""

    power_w: float = at_least_zero("power at full throttle")
    max_force_n: float = at_least_zero("drive force that torque allows at low speed")
    drag_n: float = at_least_zero("engine drag with the throttle closed")
    creep_speed_mps: float = positive("speed below which engine drag fades away")
    rolling_slip: float = fraction(
        "slip up to which power counts at road speed; from twice this at wheel speed", default=0.1
    )
    clutch_open_time_s: float = number(
        "time at which the clutch opens", infinite=True, default=math.inf
    )
    clutch_open_drag_n: float = at_least_zero("drag of axles and gearbox, clutch open", default=0.0)


@dataclass(frozen=True, kw_only=True)
class AbsSpec:
    """Anti-lock control."""

    mode: str = choice("logic", ABS_MODES)
    slip_off: float = fraction("slip at which brakes are released")
    slip_on: float = fraction("slip at which they are applied again")
    cutout_speed_mps: float = at_least_zero("no release below this speed")
    hold_s: float = at_least_zero("shortest time between two changes")


@dataclass(frozen=True, kw_only=True)
class CircuitSpec:
    """Timing of one brake circuit."""

    delay_s: float = at_least_zero("transport delay from control to chamber")
    lag_s: float = at_least_zero("first-order lag of the chamber")
    enabled: bool = switch("false: the circuit does nothing", default=True)
    fade_per_j: float = at_least_zero("torque lost per energy a hub took up", default=0.0)


@dataclass(frozen=True, kw_only=True)
class CircuitsSpec:
    """The three circuits."""

    steer: CircuitSpec = section(CircuitSpec, "steer axle")
    drive: CircuitSpec = section(CircuitSpec, "drive axles")
    trailer: CircuitSpec = section(CircuitSpec, "trailer axles")
