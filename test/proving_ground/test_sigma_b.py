"""sigma_b: what a detector of one world's nulls sees, measured on nulls left out."""

from __future__ import annotations

import numpy as np
import pytest

from proving_ground.manoeuvres import MANOEUVRES
from proving_ground.representative import representative
from proving_ground.sigma_b import Detector, Stack
from proving_ground.worlds.runs import KINDS


def stack(trucks: int, strong: np.ndarray, seed: int = 1) -> Stack:
    """Nulls that differ along one direction by much and else by nothing; noise of one."""
    rng = np.random.default_rng(seed)
    nulls = 30.0 * rng.standard_normal((trucks, 1)) * strong
    return Stack(nulls, np.zeros(nulls.shape), np.ones(strong.size), ((1, strong.size),))


def test_without_spread_it_is_the_signal_over_the_noise() -> None:
    signature = np.full(40, 0.5)
    found = Detector(stack(60, np.zeros(40))).separation(signature)
    assert found == pytest.approx(np.linalg.norm(signature), rel=0.05)


def test_what_trucks_differ_by_hides_an_effect_that_looks_like_it() -> None:
    along = np.zeros(40)
    along[:8] = 1.0 / np.sqrt(8.0)
    across = np.zeros(40)
    across[20:28] = 1.0 / np.sqrt(8.0)
    hidden, seen = map(Detector(stack(120, along)).separation, (10.0 * along, 10.0 * across))
    assert hidden < 0.6
    assert seen == pytest.approx(10.0, rel=0.1)


def shaken(trucks: int, together: bool, seed: int = 3) -> Stack:
    """Nulls of two channels that are alike but for bumps, which shake both of them."""
    rng = np.random.default_rng(seed)
    bumps = 10.0 * rng.standard_normal((trucks, 2, 60))
    if together:
        bumps[:, 1] = bumps[:, 0]
    return Stack(np.zeros((trucks, 120)), bumps.reshape(trucks, 120), np.ones(120), ((2, 60),))


def test_bumps_hide_an_effect_that_shakes_like_them() -> None:
    signature = np.full(120, 1.0)
    alike = Detector(shaken(100, together=True)).separation(signature)
    assert alike == pytest.approx(np.sqrt(120.0 / (2.0 * 10.0**2 + 1.0)), rel=0.15)


def test_channels_that_bumps_shake_together_tell_an_effect_that_moves_them_apart() -> None:
    signature = np.concatenate([np.full(60, 1.0), np.full(60, -1.0)])
    together, alone = (Detector(shaken(100, both)).separation(signature)
                       for both in (True, False))
    assert together == pytest.approx(np.sqrt(120.0), rel=0.15)
    assert alone == pytest.approx(np.sqrt(120.0 / 101.0), rel=0.15)


def test_a_baseline_run_shows_what_the_truck_is() -> None:
    """The same number moves a baseline and a training run: known there, it hides nothing here."""
    both = np.concatenate([np.full(20, 1.0), np.full(20, 1.0)]) / np.sqrt(40.0)
    alone = np.concatenate([np.zeros(20), both[20:]])
    effect = np.concatenate([np.zeros(20), np.full(20, 2.0)])
    with_baseline = Detector(stack(120, both)).separation(effect)
    without = Detector(stack(120, alone)).separation(effect)
    assert with_baseline > 3.0 * without


def test_every_manoeuvre_has_one_that_stands_for_it() -> None:
    stands = {kind: representative(kind) for kind in MANOEUVRES}
    assert {kind for kinds in KINDS.values() for kind in kinds} <= stands.keys()
    assert [one for one in stands.values() if stands.get(one) != one] == []
    assert len(set(stands.values())) < len(stands) / 4
