"""Road files: air, gravity, road surface."""

# ruff: noqa: RUF009 (section() is a dataclasses.field)
from __future__ import annotations

from dataclasses import dataclass

from truck_blowout_sim.vehicle.fields import at_least_zero, number, positive, section, text

LEAST_GRIP = 0.01  # of dry grip; wet ice has 0.05, and the limit of adhesion divides by grip


@dataclass(frozen=True, kw_only=True)
class PatchSpec:
    """A rectangle of other friction."""

    x0_m: float = number("begins at this x of map")
    x1_m: float = number("ends at this x")
    y0_m: float = number("right edge, y of map")
    y1_m: float = number("left edge")
    scale: float = number("friction there against the rest of the road", low=LEAST_GRIP)


@dataclass(frozen=True, kw_only=True)
class RoadSpec:
    """A straight road through a volume of air."""

    title: str = text("what road this is")
    gravity_mps2: float = positive("acceleration of gravity")
    air_density_kgpm3: float = at_least_zero("density of air")
    air_pressure_pa: float = positive("ambient pressure, absolute")
    air_temperature_k: float = positive("ambient temperature, also of the gas in the tires")
    wind_x_mps: float = number("steady wind along x of map", default=0.0)
    wind_y_mps: float = number("steady wind along y of map", default=0.0)
    road_grade_rad: float = number("uphill along x is positive", low=-0.5, high=0.5, default=0.0)
    road_bank_rad: float = number("left side high is positive", low=-0.5, high=0.5, default=0.0)
    road_roughness_m: float = at_least_zero("rms unevenness", default=0.0)
    road_roughness_seed: float = at_least_zero("which uneven road", default=1.0)
    friction_scale: float = number("friction against the tires' own", low=LEAST_GRIP, default=1.0)
    patch: PatchSpec | None = section(PatchSpec, "a patch of other friction", optional=True)
