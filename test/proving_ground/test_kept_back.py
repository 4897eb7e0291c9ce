"""What is kept back for sealed draws: no case of development has it, and it does what it says."""

from __future__ import annotations

import numpy as np
import pytest

from proving_ground import forms
from proving_ground.kept_back import FROM, KINDS, KeptBack, sealed
from proving_ground.laws import DUGOFF, LEAF, usual
from proving_ground.tire import similar
from proving_ground.worlds import CYCLE, FIRST_SEED, WORLDS, world_cases
from proving_ground.worlds.runs import KINDS as OPEN_KINDS

SLOPE, PEAK = 170e3, 20e3


def dugoff(slip_rad: float) -> float:
    return similar(0.0, slip_rad, 300e3, SLOPE, 22e3, PEAK, usual()._replace(family=DUGOFF))[1]


def test_development_has_nothing_of_what_is_kept_back() -> None:
    assert FROM % len(CYCLE) == 0
    for first in FIRST_SEED.values():
        assert not any(sealed(first + number) for number in (0, 1000, FROM - 1))
        assert KeptBack.of(first + 7) == KeptBack()
    laws = [forms.draw(FIRST_SEED["w2"] + number).laws for number in range(40)]
    assert all(law.family != DUGOFF and law.friction_law != LEAF for law in laws)


def test_a_third_of_the_sealed_cases_has_each_of_it() -> None:
    drawn = [KeptBack.of(FIRST_SEED["w2"] + FROM + number) for number in range(300)]
    for part in ("tire", "suspension", "instruments"):
        assert 70 <= sum(getattr(one, part) for one in drawn) <= 130


@pytest.mark.parametrize("world", WORLDS)
def test_sealed_runs_are_of_kinds_that_no_other_case_of_a_truck_has(world: str) -> None:
    known = {kind for kinds in OPEN_KINDS.values() for kind in kinds}
    own = {kind for kinds in KINDS.values() for kind in kinds}
    assert not known & own
    for spec in world_cases(world, FROM, len(CYCLE)):
        if spec.truth != "w3" and spec.train != ("ordinary_drive",):
            assert {*spec.train, *spec.holdout, *spec.baseline} <= own


def test_the_tire_kept_back_follows_its_law() -> None:
    # Dugoff: linear up to half of its grip, then F = P (1 - P / (4 C s)), no peak
    assert dugoff(0.04) == pytest.approx(SLOPE * 0.04)
    assert dugoff(0.2) == pytest.approx(PEAK * (1.0 - PEAK / (4.0 * SLOPE * 0.2)))
    assert dugoff(0.1) < dugoff(0.3) < PEAK


def test_the_instruments_kept_back_read_position_ten_times_a_second() -> None:
    clean = {"tractor_vx_mps": np.full(1000, 20.0), "tractor_yaw_rate_radps": np.zeros(1000)}
    read = KeptBack(instruments=True).read(clean, 1)
    assert np.isfinite(read["tractor_vx_mps"]).sum() == 100
    assert np.std(read["tractor_yaw_rate_radps"]) == pytest.approx(np.radians(0.1), rel=0.1)
    assert KeptBack().read(clean, 1) is clean
