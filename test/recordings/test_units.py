"""Units as loggers spell them."""

from __future__ import annotations

import math

import pytest

from truck_blowout_sim.recordings.units import find_unit, units_of


@pytest.mark.parametrize(("text", "number", "si"), [
    ("km/h", 36.0, 10.0), ("kph", 36.0, 10.0), ("mph", 1.0, 0.44704), ("knots", 1.0, 1852 / 3600),
    ("deg", 180.0, math.pi), ("°", 180.0, math.pi), ("[deg/s]", 180.0, math.pi),
    ("°/s", 180.0, math.pi), ("rpm", 60.0, 2 * math.pi), ("g", 1.0, 9.80665),
    ("m/s^2", 1.0, 1.0), ("m/s²", 1.0, 1.0), ("psi", 1.0, 6894.757293168361),
    ("psia", 14.695948775513, 0.0), ("bar", 1.0, 1e5), ("bar abs", 1.01325, 0.0),
    ("kPa absolute", 101.325, 0.0), ("MPa abs", 0.201325, 1e5), ("hPa absolute", 1013.25, 0.0),
    ("MPa", 1.0, 1e6), ("%", 50.0, 0.5), ("ft", 1.0, 0.3048),
    ("kn", 1.0, 1852 / 3600), ("[kn]", 1.0, 1852 / 3600), ("Knots", 1.0, 1852 / 3600),
    ("kt", 1.0, 1852 / 3600), ("kts", 1.0, 1852 / 3600), ("kN", 1.0, 1e3), ("(kN)", 1.0, 1e3),
    ("ms", 1.0, 1e-3), ("(km/h)", 36.0, 10.0),
])  # fmt: skip
def test_value_in_si(text: str, number: float, si: float) -> None:
    unit = find_unit(text)
    assert unit is not None
    assert number * unit.factor + unit.offset == pytest.approx(si, abs=1e-6)


@pytest.mark.parametrize("text", ["", "mPa", "furlong", "deg/km"])
def test_what_is_no_unit(text: str) -> None:
    assert find_unit(text) is None


def test_the_first_unit_of_a_quantity_is_si() -> None:
    for quantity in ("angle", "speed", "acceleration", "pressure", "length", "angular rate"):
        unit = find_unit(units_of(quantity)[0])
        assert unit is not None
        assert (unit.factor, unit.offset) == (1.0, 0.0)
