"""Radii, stiffness and volume of a tire from the size on its sidewall."""

from __future__ import annotations

import pytest

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.vehicle.document import Place
from truck_blowout_sim.vehicle.single_track.tire_size import parse_size

PLACE = Place("mine.yaml", 3, "tire")


@pytest.mark.parametrize(("text", "radius_m"), [
    ("205/55R16", 0.316), ("275/80R22.5", 0.506), ("315/80 R 22.5", 0.538), ("11R22.5", 0.527),
    ("P215/60R16", 0.332), ("185/70-14", 0.307),
])  # fmt: skip
def test_free_radius_agrees_with_the_tables(text: str, radius_m: float) -> None:
    assert parse_size(text, PLACE).radius_m == pytest.approx(radius_m, abs=0.003)


def test_radial_stiffness_of_the_measured_truck_tire_is_met() -> None:
    size = parse_size("275/80R22.5", PLACE)
    rate = size.structure_npm + size.stiffness_npmppa * 110 * 6894.757
    assert rate == pytest.approx(968e3, rel=0.05)  # 83.7 + 8.04 p, p = 110 psi


def test_radial_stiffness_of_a_car_tire_is_usual() -> None:
    size = parse_size("205/55R16", PLACE)
    assert 180e3 < size.structure_npm + size.stiffness_npmppa * 2.3e5 < 280e3


def test_gas_volume_of_the_truck_tire_is_that_of_its_section() -> None:
    assert parse_size("275/80R22.5", PLACE).volume_m3 == pytest.approx(0.106, rel=0.05)


@pytest.mark.parametrize("text", ["", "22.5", "wide", "205/55", "R16", "1/2R3"])
def test_what_is_no_size_is_refused_where_it_stands(text: str) -> None:
    with pytest.raises(InputError, match=r"mine\.yaml, line 3: tire: .* is no tire size"):
        parse_size(text, PLACE)
