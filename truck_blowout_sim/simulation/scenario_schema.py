"""Sections of a scenario file: who drives, how fast, what bursts when.

Keys carry units as in vehicle files (`angle_deg`, `pressure_psi`); values may carry sources.
"""

# ruff: noqa: RUF009 (section() is a dataclasses.field)
from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

from truck_blowout_sim.simulation.pilot import REACT_STEERING, REACT_THROTTLE
from truck_blowout_sim.vehicle.fields import (
    at_least_zero,
    choice,
    number,
    numbers,
    positive,
    section,
    sections,
    text,
)


@dataclass(frozen=True, kw_only=True)
class StartSpec:
    """Where and how fast the truck starts, settled on its springs."""

    speed_mps: float = at_least_zero("forward speed at the tractor's base_link")
    x_m: float = number("position in map", default=0.0)
    y_m: float = number("position in map", default=0.0)
    yaw_rad: float = number("heading", default=0.0)


@dataclass(frozen=True, kw_only=True)
class SteeringTableSpec:
    """Hand-wheel angle over time, linear between the points, held outside."""

    time_s: tuple[float, ...] = numbers("times of the points, increasing")
    angle_rad: tuple[float, ...] = numbers("hand-wheel angles there, left positive")


@dataclass(frozen=True, kw_only=True)
class SweepSpec:
    """Sine of rising frequency at the hand wheel."""

    amplitude_rad: float = positive("hand-wheel amplitude")
    start_hz: float = positive("frequency at its beginning")
    end_hz: float = positive("frequency at its end; rises exponentially in between")
    start_s: float = number("begins at this time", default=0.0)
    end_s: float = number("ends at this time")


@dataclass(frozen=True, kw_only=True)
class FollowSpec:
    """A driver who steers towards a point of the path ahead (pure pursuit)."""

    x_m: tuple[float, ...] = numbers("points of the path in map, in order of driving")
    y_m: tuple[float, ...] = numbers("points of the path in map")
    preview_s: float = positive("looks so far ahead", default=1.0)
    least_preview_m: float = positive("looks at least so far ahead", default=8.0)
    lag_s: float = at_least_zero("lag of the hands", default=0.15)
    fastest_radps: float = positive("fastest turn of the hand wheel", default=12.0)
    most_rad: float = positive("largest hand-wheel angle", default=12.0)
    understeer_rads2pm: float = number(
        "road-wheel angle the driver adds per lateral acceleration", default=0.005
    )
    trim_radpms: float = at_least_zero(
        "road-wheel angle a second that a meter beside the path makes him add", default=0.002
    )
    until_s: float = number(
        "after this time the driver holds what he has", infinite=True, default=math.inf
    )


@dataclass(frozen=True, kw_only=True)
class SteeringSpec:
    """One of: a table, a sweep, a path to follow."""

    table: SteeringTableSpec | None = section(SteeringTableSpec, "angle over time", optional=True)
    sweep: SweepSpec | None = section(SweepSpec, "sine sweep", optional=True)
    follow: FollowSpec | None = section(FollowSpec, "path to follow", optional=True)


@dataclass(frozen=True, kw_only=True)
class ThrottleSpec:
    """Throttle over time, linear between the points, held outside."""

    time_s: tuple[float, ...] = numbers("times of the points, increasing")
    opening: tuple[float, ...] = numbers("throttle there, 0 to 1", low=0.0)


@dataclass(frozen=True, kw_only=True)
class SpeedProfileSpec:
    """Speed over time, linear between the points, held outside."""

    time_s: tuple[float, ...] = numbers("times of the points, increasing")
    speed_mps: tuple[float, ...] = numbers("speeds there", low=0.0)


@dataclass(frozen=True, kw_only=True)
class HoldSpec:
    """Speed held with the throttle; afterwards the throttle table rules."""

    speed_mps: float = at_least_zero(
        "speed to hold; without it and without a profile, the speed of the start",
        default=math.nan)
    profile: SpeedProfileSpec | None = section(
        SpeedProfileSpec, "speed to hold over time", optional=True)
    until_s: float = number("up to this time", infinite=True, default=math.inf)
    gain_spm: float = positive("throttle per speed error", default=0.5)
    integral_pm: float = at_least_zero("throttle per distance lost", default=0.1)


@dataclass(frozen=True, kw_only=True)
class PressureSpec:
    """Control pressure over time, linear between the points, held outside."""

    time_s: tuple[float, ...] = numbers("times of the points, increasing")
    pressure_pa: tuple[float, ...] = numbers("gauge pressures there", low=0.0)


@dataclass(frozen=True, kw_only=True)
class BrakesSpec:
    """Control pressure of each circuit."""

    steer: PressureSpec | None = section(PressureSpec, "steer axle", optional=True)
    drive: PressureSpec | None = section(PressureSpec, "drive axles", optional=True)
    trailer: PressureSpec | None = section(PressureSpec, "trailer axles", optional=True)


@dataclass(frozen=True, kw_only=True)
class WhenSpec:
    """A condition: met at the first instant at which everything it asks for is true."""

    after_s: float = number("not before this time", default=math.nan)
    speed_below_mps: float = at_least_zero("tractor slower than this", default=math.nan)
    speed_above_mps: float = at_least_zero("tractor faster than this", default=math.nan)
    x_past_m: float = number("tractor's center of gravity beyond this x of map", default=math.nan)
    distance_m: float = at_least_zero("so far driven since the start", default=math.nan)
    yaw_rate_above_radps: float = at_least_zero(
        "tractor turns faster than this, to either side", default=math.nan)


@dataclass(frozen=True, kw_only=True)
class BlowoutEventSpec:
    """Tires that burst at one instant: at a time, or when a condition is met."""

    time_s: float = number("instant; this or `when`", default=math.nan)
    when: WhenSpec | None = section(WhenSpec, "condition it waits for", optional=True)
    delay_s: float = at_least_zero("so long after the condition is met", default=0.0)
    tires: str = text("tires or hubs, joined by +, or none")


@dataclass(frozen=True, kw_only=True)
class ReactionSpec:
    """What the driver does once a tire has burst; until then hands and feet stay as they are."""

    when: WhenSpec | None = section(
        WhenSpec, "condition the driver reacts to; the first burst where it is not given",
        optional=True)
    time_s: float = number(
        "reaction time: from burst or condition to the driver's first action; .inf: none, ever",
        low=0.0, infinite=True, default=1.0)
    steering: str = choice(
        "goes on steering as the scenario says, or holds the hand wheel where it is",
        REACT_STEERING, default="as_before")
    throttle: str = choice(
        "as the scenario says, lifted, or used to hold the speed of the burst",
        REACT_THROTTLE, default="as_before")
    throttle_over_s: float = at_least_zero("time over which the throttle is lifted", default=0.3)
    brake_pa: float = at_least_zero("control pressure of all circuits; 0: no braking", default=0.0)
    brake_delay_s: float = at_least_zero(
        "from the driver's first action to the brake pedal", default=0.2)
    brake_over_s: float = at_least_zero("time over which the pressure rises", default=0.3)


@dataclass(frozen=True, kw_only=True)
class ScenarioSpec:
    """A run: how it starts, who drives, what bursts."""

    title: str = text("what happens, in one line")
    start_s: float = number("time at which it starts", default=0.0)
    end_s: float = number("time at which it ends")
    start: StartSpec | None = section(StartSpec, "how the truck starts", optional=True)
    recording: str = text("a recording that drives what is not said below", default="")
    road: str = text("a road file instead of the vehicle's", default="")
    lane_width_m: float = positive(
        "lane whose edges count in the measures of a run; 12 ft, AASHTO", default=3.66)
    steering: SteeringSpec | None = section(SteeringSpec, "hand wheel", optional=True)
    throttle: ThrottleSpec | None = section(ThrottleSpec, "throttle", optional=True)
    hold: HoldSpec | None = section(HoldSpec, "speed held", optional=True)
    brakes: BrakesSpec | None = section(BrakesSpec, "brakes", optional=True)
    reaction: ReactionSpec | None = section(
        ReactionSpec, "what the driver does about a burst", optional=True)
    blowouts: Mapping[str, BlowoutEventSpec] = sections(BlowoutEventSpec, "what bursts, by name")
