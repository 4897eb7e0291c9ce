"""What a single-track vehicle states. 0, or an empty text, stands for "by rule of thumb"."""

# ruff: noqa: RUF009 (section() is a dataclasses.field)
from __future__ import annotations

from dataclasses import dataclass

from truck_blowout_sim.vehicle.fields import at_least_zero, choice, number, positive, section, text

KINDS = ("car", "truck")
DRIVEN = ("rear", "front", "all")


@dataclass(frozen=True, kw_only=True)
class SingleTrailerSpec:
    """A semitrailer. Its axles form one group; give its center of gravity in one of two ways."""

    mass_kg: float = positive("mass with load and axles")
    wheelbase_m: float = positive("kingpin to the middle of the axles")
    yaw_inertia_kgm2: float = at_least_zero("of the whole trailer, axles included", default=0.0)
    cg_x_m: float = at_least_zero("center of gravity behind the kingpin", default=0.0)
    kingpin_load_kg: float = at_least_zero("mass that rests on the fifth wheel", default=0.0)
    cornering_nprad: float = at_least_zero("cornering stiffness of all axles together", default=0.0)
    axles: float = number("number of axles", low=1.0, high=4.0, default=2.0)
    axle_spread_m: float = at_least_zero("between neighboring axles", default=0.0)
    tires_per_axle: float = number("2 or 4", low=2.0, high=4.0, default=4.0)
    tire: str = text("size on the sidewall, such as 11R22.5", default="")
    cg_height_m: float = at_least_zero("center of gravity above the road", default=0.0)
    track_m: float = at_least_zero("between the wheel centers, duals at their middle", default=0.0)


@dataclass(frozen=True, kw_only=True)
class SingleTrackSpec:
    """A car, bus, truck or tractor with one front axle and one group of rear axles.

    Masses and the center of gravity are those of this unit alone, as it was driven, without the
    trailer. Give the center of gravity as `cg_x_m` or as `front_load_kg`.
    """

    kind: str = choice("which rules fill in the rest; truck: also a bus or a tractor", KINDS)
    mass_kg: float = positive("mass as driven, with its axles and without a trailer")
    wheelbase_m: float = positive("front axle to the middle of the rear axles")
    cg_x_m: float = at_least_zero("center of gravity behind the front axle", default=0.0)
    front_load_kg: float = at_least_zero("mass that rests on the front axle", default=0.0)
    yaw_inertia_kgm2: float = at_least_zero("of the whole unit about its own center", default=0.0)
    front_cornering_nprad: float = at_least_zero(
        "effective cornering stiffness of the front axle", default=0.0
    )
    rear_cornering_nprad: float = at_least_zero(
        "effective cornering stiffness of all rear axles together", default=0.0
    )
    steering_ratio: float = positive("hand-wheel angle per mean road-wheel angle")
    tire: str = text("size on the sidewall of the front tires, such as 205/55R16 or 11R22.5")
    rear_tire: str = text("size of the rear tires; empty: as in front", default="")
    rear_axles: float = number("number of rear axles", low=1.0, high=3.0, default=1.0)
    rear_axle_spread_m: float = at_least_zero("between neighboring rear axles", default=0.0)
    rear_tires_per_axle: float = number("2 or 4; 0: by rule", low=0.0, high=4.0, default=0.0)
    driven: str = choice("driven axles", DRIVEN, default="rear")
    tire_pressure_pa: float = at_least_zero("gauge pressure of all tires", default=0.0)
    cg_height_m: float = at_least_zero("center of gravity above the road", default=0.0)
    track_m: float = at_least_zero("between the wheel centers, duals at their middle", default=0.0)
    drag_area_m2: float = at_least_zero("drag coefficient times frontal area", default=0.0)
    power_w: float = at_least_zero("engine power", default=0.0)
    hitch_x_m: float = at_least_zero("fifth wheel behind the front axle", default=0.0)
    hitch_height_m: float = at_least_zero("fifth wheel above the road", default=0.0)
    trailer: SingleTrailerSpec | None = section(SingleTrailerSpec, "a semitrailer", optional=True)
