"""What is kept back for sealed draws: no case of development has it, and it does what it says."""

from __future__ import annotations

import numpy as np
import pytest

from proving_ground import forms
from proving_ground.chassis import damper_force
from proving_ground.kept_back import FROM, KINDS, LATER, KeptBack, sealed
from proving_ground.laws import BLOW_OFF, BURCKHARDT, DUGOFF, LEAF, usual
from proving_ground.run import Rig
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


def test_later_draws_have_forms_that_earlier_ones_had_not() -> None:
    earlier = [forms.draw(FIRST_SEED["w2"] + FROM + number).laws for number in range(30)]
    assert all(law.family != BURCKHARDT and law.damper_law != BLOW_OFF for law in earlier)
    drawn = [forms.draw(FIRST_SEED["w2"] + LATER + number).laws for number in range(60)]
    assert all(law.family != DUGOFF and law.friction_law != LEAF for law in drawn)
    assert 8 <= sum(law.family == BURCKHARDT for law in drawn) <= 34
    assert 8 <= sum(law.damper_law == BLOW_OFF for law in drawn) <= 34


def test_the_later_tire_has_the_slope_and_the_peak_of_the_sheet() -> None:
    # Burckhardt's dry asphalt: peak at a slip of 0.17, then it falls to 65 % as the wheel locks
    laws = usual()._replace(family=BURCKHARDT)
    force = [similar(0.0, s, 300e3, SLOPE, 22e3, PEAK, laws)[1] for s in np.linspace(1e-4, 5, 9000)]
    assert force[0] == pytest.approx(SLOPE * 1e-4, rel=2e-3)
    assert max(force) == pytest.approx(PEAK, rel=1e-4)
    assert force[-1] == pytest.approx(0.65 * PEAK, rel=0.01)


def test_a_damper_whose_valve_is_open_resists_less() -> None:
    truck = Rig(forms.draw_individual(1))._constants
    laws = truck.laws._replace(damper_law=BLOW_OFF)
    slow, fast = (damper_force(truck._replace(laws=laws), 0, rate) for rate in (0.05, 0.3))
    assert slow == pytest.approx(damper_force(truck, 0, 0.05))
    assert fast == pytest.approx(slow * (0.1 + laws.blow_off_share * 0.2) / 0.05)
    assert damper_force(truck._replace(laws=laws), 0, -0.3) < 0.0


def test_on_the_bus_a_reading_is_coarse_and_not_always_fresh() -> None:
    clean = {"hub_speed_drive_1_left_radps": np.linspace(40.0, 41.0, 1000),
             "brake_chamber_drive_1_left_pa": np.linspace(0.0, 3e5, 1000),
             "tractor_yaw_rate_radps": np.zeros(1000)}
    read = KeptBack(instruments=True, later=True).read(clean, 1)
    fresh = {name: signal[np.isfinite(signal)] for name, signal in read.items()}
    assert [one.size for one in fresh.values()] == [100, 100, 1000]
    np.testing.assert_allclose(np.mod(fresh["brake_chamber_drive_1_left_pa"], 8000.0), 0.0)
    steps = fresh["tractor_yaw_rate_radps"] * 8192.0
    np.testing.assert_allclose(steps, np.round(steps), atol=1e-9)


def test_the_instruments_kept_back_read_position_ten_times_a_second() -> None:
    clean = {"tractor_vx_mps": np.full(1000, 20.0), "tractor_yaw_rate_radps": np.zeros(1000)}
    read = KeptBack(instruments=True).read(clean, 1)
    assert np.isfinite(read["tractor_vx_mps"]).sum() == 100
    assert np.std(read["tractor_yaw_rate_radps"]) == pytest.approx(np.radians(0.1), rel=0.1)
    assert KeptBack().read(clean, 1) is clean
