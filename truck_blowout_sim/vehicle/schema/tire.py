"""Tire files and blowout files."""

# ruff: noqa: RUF009 (section() is a dataclasses.field)
from __future__ import annotations

from dataclasses import dataclass

from truck_blowout_sim.vehicle.fields import (
    at_least_zero,
    choice,
    fraction,
    number,
    numbers,
    positive,
    section,
    text,
)
from truck_blowout_sim.vehicle.schema.road import LEAST_GRIP

MODELS = ("magic_formula", "map", "linear")
LAWS = ("continuous", "steps")
ROW_8 = ("as_printed", "linear_series")


@dataclass(frozen=True, kw_only=True)
class TireMapSpec:
    """Lateral force and aligning moment over slip angle and load, both from 0 in even steps.

    Values go row by row, one row a slip angle; magnitudes, so positive where the tire restores.
    """

    slip_step_rad: float = positive("step of the slip angle")
    load_step_n: float = positive("step of the load")
    loads: float = positive("number of loads, the one of 0 included")
    lateral_n: tuple[float, ...] = numbers("lateral force", low=0.0)
    aligning_nm: tuple[float, ...] = numbers("aligning moment")


@dataclass(frozen=True, kw_only=True)
class RimSpec:
    """A tire on its rim: what the blowout file says for all tires, of one of another size."""

    rim_radius_m: float = positive("loaded radius at which carcass and rim begin to touch")
    rim_span_m: float = positive("loss of radius from there to rho = 1")
    rim_contact_radius_m: float = positive("loaded radius below which the rim carries")
    rim_stiffness_npm: float = at_least_zero("radial stiffness on the rim")
    flat_radius_m: float = positive("rolling radius at rho = 1")
    flat_relaxation_m: float = positive("lateral relaxation length at rho = 1")


@dataclass(frozen=True, kw_only=True)
class TireSpec:
    """One kind of tire. d = load / reference load - 1, q = pressure / reference pressure."""

    title: str = text("what the sidewall says")
    model: str = choice("force model", MODELS, default="magic_formula")
    unloaded_radius_m: float = positive("free radius")
    radius_fraction: float = fraction("part of the deflection that shortens the rolling radius")
    radius_offset_m: float = number("added to the rolling radius", default=0.0)
    stiffness_npm: float = at_least_zero("radial stiffness without pressure")
    stiffness_npmppa: float = at_least_zero("radial stiffness per gauge pressure")
    damping_nspm: float = at_least_zero("radial damping")
    pressure_pa: float = at_least_zero("gauge pressure it is set to")
    reference_pressure_pa: float = positive("gauge pressure the coefficients hold at")
    volume_m3: float = positive("gas volume, inflated")
    hole_area_m2: float = positive("effective area of the hole of a blowout")
    reference_load_n: float = positive("load the coefficients hold at")
    friction_scale: float = number("scales peak friction of this tire", low=LEAST_GRIP)
    shape_y: float = positive("C of the lateral formula")
    curvature_y: float = number("E of the lateral formula", high=1.0)
    peak_y: float = number("lateral peak friction at the reference load", low=LEAST_GRIP)
    peak_y_load: float = number("its loss per d")
    cornering_peak: float = positive("largest cornering stiffness over reference load, per rad")
    cornering_load: float = positive("load of the largest cornering stiffness over reference load")
    cornering_scale: float = positive("cornering stiffness against the rib tire")
    cornering_floor_1: float = fraction("part of the largest cornering stiffness left at q = 0")
    cornering_floor_2: float = fraction("part of the load of that maximum left at q = 0")
    shape_x: float = positive("C of the longitudinal formula")
    curvature_x: float = number("E of the longitudinal formula", high=1.0)
    peak_x: float = number("longitudinal peak friction at the reference load", low=LEAST_GRIP)
    peak_x_load: float = number("its loss per d")
    slip_stiffness: float = positive("slip stiffness over load at the reference load")
    slip_stiffness_load: float = number("its loss per d")
    lateral_stiffness_npm: float = positive("lateral carcass stiffness, for relaxation")
    longitudinal_stiffness_npm: float = positive("longitudinal carcass stiffness, for relaxation")
    trail_0: float = number("pneumatic trail over free radius at the reference load")
    trail_load: float = number("its loss per d")
    trail_pressure: float = number("its growth per loss of q")
    trail_shape: float = number("shape of the trail over slip angle")
    trail_stretch: float = positive("stretch of the trail over slip angle, per rad")
    camber_gain: float = number("camber thrust over load, per rad")
    rolling_0: float = at_least_zero("rolling resistance over load at standstill")
    rolling_spm: float = at_least_zero("its growth per speed")
    rolling_pressure_exponent: float = at_least_zero("rolling resistance goes with q^-exponent")
    linear_cornering_nprad: float = at_least_zero("cornering stiffness, linear model", default=0.0)
    linear_slip_n: float = at_least_zero("longitudinal stiffness, linear model", default=0.0)
    map: TireMapSpec | None = section(
        TireMapSpec, "map model; absent: made from the formula at the set pressure", optional=True
    )
    rim: RimSpec | None = section(
        RimSpec, "this tire on its rim; absent: as the blowout file says", optional=True
    )


@dataclass(frozen=True, kw_only=True)
class StepTableSpec:
    """A tire swapped at instants after the blowout; lists of one length, one entry a swap."""

    time_s: tuple[float, ...] = numbers("instant after the blowout", low=0.0)
    radius_m: tuple[float, ...] = numbers("effective rolling radius", low=0.0)
    stiffness_npm: tuple[float, ...] = numbers("radial stiffness", low=0.0)
    cornering_scale: tuple[float, ...] = numbers("lateral force against the sound tire", low=0.0)
    aligning_scale: tuple[float, ...] = numbers("aligning moment against the sound tire", low=0.0)
    rolling_0: tuple[float, ...] = numbers("rolling resistance over load at standstill", low=0.0)
    rolling_spm: tuple[float, ...] = numbers("its growth per speed", low=0.0)


@dataclass(frozen=True, kw_only=True)
class BlowoutSpec:
    """What becomes of a tire that loses its gas. rho is the part of rim contact, 0 to 1."""

    title: str = text("what law this is")
    law: str = choice("continuous in pressure and rim contact, or a table of steps", LAWS)
    polytropic: float = number("1 isothermal to 1.4 adiabatic gas", low=1.0, high=1.4)
    flat_volume_fraction: float = number("part of the volume lost at rho = 1", low=0.0, high=0.99)
    pressure_valid: float = number("q below which the pressure terms stay as they are",
                                   above=0.0, high=1.0)
    rim_radius_m: float = positive("loaded radius at which carcass and rim begin to touch")
    rim_span_m: float = positive("loss of radius from there to rho = 1")
    rim_contact_radius_m: float = positive("loaded radius below which the rim carries")
    rim_stiffness_npm: float = at_least_zero("radial stiffness on the rim")
    rim_damping_ratio: float = at_least_zero("damping on the rim, of half an axle on it")
    flat_cornering: float = at_least_zero("cornering stiffness at rho = 1 against rho = 0")
    flat_trail: float = at_least_zero("pneumatic trail at rho = 1 against rho = 0")
    flat_camber: float = at_least_zero("camber thrust at rho = 1 against rho = 0")
    flat_rolling: float = at_least_zero("rolling resistance over load at rho = 1")
    flat_relaxation_m: float = positive("lateral relaxation length at rho = 1")
    flat_radius_m: float = positive("rolling radius at rho = 1")
    table_10_row_8: str = choice("speed part of the eighth swap", ROW_8, default="as_printed")
    steps: StepTableSpec | None = section(StepTableSpec, "the table of steps", optional=True)
