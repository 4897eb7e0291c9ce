"""What fault-free vehicles differ by: a spread with a source for every strength, closed forms."""

from __future__ import annotations

import math

import pytest
import yaml

from proving_ground.car.effects import CAR_LISTED
from proving_ground.effects import LISTED
from proving_ground.spreads import FILE, individual

NONE_HAS_IT = {"hole area"}  # no tire of a sound vehicle bursts


def strength(name: str, value: float) -> dict[str, object]:
    return {"name": name, "value": value, "unit": "1"}


def test_every_effect_of_a_list_has_a_spread_or_is_found_on_no_sound_vehicle() -> None:
    known = yaml.safe_load(FILE.read_text(encoding="utf-8"))
    for kind in (*LISTED.values(), *CAR_LISTED.values()):
        for law in (kind.set, *kind.others):
            name = law(0.5, kind.places[0], 1.0, 3.0).strength.name
            assert name in known or name in NONE_HAS_IT, name
    assert all(one["spread"] > 0.0 and one["source"] for one in known.values())


def test_a_strength_is_counted_in_spreads() -> None:
    assert individual(strength("grade, uphill", -0.003)) == pytest.approx(5.0)
    assert individual(strength("torque ratio to a sound brake", 0.35)) == pytest.approx(10.0)
    twice = individual(strength("relaxation length ratio", 2.0))
    assert individual(strength("relaxation length ratio", 0.5)) == pytest.approx(twice)
    assert individual(strength("extra drag area", 0.5), car=True) == pytest.approx(
        10.0 * individual(strength("extra drag area", 0.5)))
    assert math.isinf(individual(strength("hole area", 1e-3)))
