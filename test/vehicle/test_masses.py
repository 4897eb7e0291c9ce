"""Centers of gravity and inertias of bodies with payload."""

from __future__ import annotations

from itertools import product

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from truck_blowout_sim.vehicle import Vehicle
from truck_blowout_sim.vehicle.masses import MassProperties, box_mass, combine, unit_mass
from truck_blowout_sim.vehicle.schema.body import PayloadSpec

SIZES = st.floats(0.1, 20.0)
PLACES = st.floats(-10.0, 10.0)


@st.composite
def point_clouds(draw: st.DrawFn) -> list[tuple[float, float, float]]:
    """Mass, x rearward, z of some points."""
    return draw(st.lists(st.tuples(st.floats(1.0, 5e3), PLACES, SIZES), min_size=1, max_size=6))


@settings(deadline=None)
@given(point_clouds())
def test_combined_points_have_the_inertia_of_the_sum(
    points: list[tuple[float, float, float]],
) -> None:
    whole = combine(MassProperties(m, x, z, 0.0, 0.0, 0.0, 0.0) for m, x, z in points)
    mass = sum(m for m, _, _ in points)
    about_origin = sum(m * (x**2 + z**2) for m, x, z in points)
    moved = whole.iyy_kgm2 + mass * (whole.x_m**2 + whole.z_m**2)
    assert whole.mass_kg == pytest.approx(mass)
    assert moved == pytest.approx(about_origin, rel=1e-9)
    product_forward = sum(-m * x * z for m, x, z in points)  # x counts rearward here
    assert whole.ixz_kgm2 - mass * whole.x_m * whole.z_m == pytest.approx(
        product_forward, rel=1e-9, abs=1e-6 * about_origin
    )


@settings(deadline=None)
@given(SIZES, SIZES, SIZES)
def test_a_box_is_the_sum_of_its_eight_parts(length: float, width: float, height: float) -> None:
    def box(mass: float, x: float, z: float, scale: float) -> PayloadSpec:
        return PayloadSpec(
            mass_kg=mass,
            x_m=x,
            z_m=z,
            length_m=length * scale,
            width_m=width,
            height_m=height * scale,
        )

    whole = box_mass(box(800.0, 3.0, 30.0, 1.0))
    quarters = [
        box_mass(box(200.0, 3.0 + i * length / 4, 30.0 + k * height / 4, 0.5))
        for i, k in product((-1, 1), (-1, 1))
    ]
    assert combine(quarters) == pytest.approx(whole, rel=1e-9, abs=1e-7)


def test_nothing_weighs_nothing() -> None:
    assert combine([]).mass_kg == 0.0


def test_the_default_combination_weighs_what_the_test_truck_did(default_vehicle: Vehicle) -> None:
    spec = default_vehicle.spec
    sprung = sum(unit_mass(unit).mass_kg for unit in default_vehicle.unit_specs.values())
    total = sprung + sum(axle.mass_kg for axle in spec.axles.values())
    assert total == pytest.approx(52_000 * 0.45359237, rel=0.001)


@pytest.mark.parametrize(
    ("unit", "mass", "x", "izz"),
    # with axles, tires and payload; the engineering reference behind the file gives these
    [("tractor", 8198.0, 2.42, 55_150.0), ("trailer", 15388.0, 6.64, 375_500.0)],
)
def test_units_with_their_axles_have_the_known_yaw_inertia(
    default_vehicle: Vehicle, unit: str, mass: float, x: float, izz: float
) -> None:
    axles = [axle for axle in default_vehicle.spec.axles.values() if axle.unit == unit]
    parts = [unit_mass(default_vehicle.unit_specs[unit])]
    parts += [
        MassProperties(a.mass_kg, a.x_m, 0.5, a.ixx_kgm2, 0.0, a.izz_kgm2, 0.0) for a in axles
    ]
    whole = combine(parts)
    assert whole.mass_kg == pytest.approx(mass)
    assert whole.x_m == pytest.approx(x, abs=0.01)
    assert whole.izz_kgm2 == pytest.approx(izz, rel=0.03)
