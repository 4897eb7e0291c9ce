"""Units of keys."""

from __future__ import annotations

import math

import pytest

from truck_blowout_sim.vehicle.units import UNITS, si_key, spellings


@pytest.mark.parametrize(
    ("key", "si", "factor"),
    [
        ("mass_lb", "mass_kg", 0.45359237),
        ("pressure_psi", "pressure_pa", 6894.757293168361),
        ("toe_in_deg", "toe_in_rad", math.pi / 180),
        ("stiffness_nmpdeg", "stiffness_nmprad", 180 / math.pi),
        ("spring_npmm", "spring_npm", 1000.0),
        ("rolling_hpkm", "rolling_spm", 3.6),
        ("cutout_speed_mph", "cutout_speed_mps", 0.44704),
        ("linear_nmppsi", "linear_nmppa", 1 / 6894.757293168361),
        ("mass_kg", "mass_kg", 1.0),
        ("circuit", "circuit", 1.0),
        ("in", "in", 1.0),
    ],
)
def test_a_key_becomes_si(key: str, si: str, factor: float) -> None:
    name, scale = si_key(key)
    assert name == si
    assert scale == pytest.approx(factor, rel=1e-12)


def test_no_unit_is_converted_to_one_that_is_converted_again() -> None:
    assert not {unit.si for unit in UNITS.values()} & set(UNITS)


def test_spellings_of_a_key_all_lead_back_to_it() -> None:
    assert "mass_lb" in spellings("mass_kg")
    assert {si_key(key)[0] for key in spellings("pressure_pa")} == {"pressure_pa"}
    assert spellings("ratio") == ("ratio",)
