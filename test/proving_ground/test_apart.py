"""How far an effect is from what a listed one can imitate."""

from __future__ import annotations

import numpy as np
import pytest

from proving_ground.apart import others
from proving_ground.sigma_b import Detector, Stack
from proving_ground.worlds import world_cases

SIZE = 40


def plain() -> Detector:
    """Vehicles that differ by nothing; noise of one."""
    return Detector(Stack(*np.zeros((2, 60, SIZE)), np.ones(SIZE), ((1, SIZE),)))


def along(*angles_rad: float) -> np.ndarray:
    """Signatures of length ten in the plane of the first two entries."""
    out = np.zeros((len(angles_rad), SIZE))
    out[:, 0], out[:, 1] = 10.0 * np.cos(angles_rad), 10.0 * np.sin(angles_rad)
    return out


def test_beside_its_own_multiple_nothing_is_left_of_a_signature() -> None:
    (signature,) = along(0.3)
    assert plain().separation(signature) == pytest.approx(10.0, rel=0.05)
    assert plain().separation(signature, -3.0 * signature) == pytest.approx(0.0, abs=1e-6)


def test_beside_another_signature_the_part_across_it_is_left() -> None:
    signature, other = along(0.0, np.pi / 6.0)
    assert plain().separation(signature, other) == pytest.approx(10.0 * np.sin(np.pi / 6.0),
                                                                 rel=0.05)
    assert plain().amount(signature, other) == pytest.approx(np.cos(np.pi / 6.0), rel=1e-6)


def test_a_signature_of_nothing_explains_nothing() -> None:
    (signature,) = along(0.0)
    assert plain().separation(signature, np.zeros(SIZE)) == pytest.approx(10.0, rel=0.05)


def test_what_a_case_does_without_is_not_among_the_listed_effects() -> None:
    taken_out = next(spec for spec in world_cases("w2", 0, 24) if spec.without)
    names = {effect.name for effect in others(taken_out)}
    assert names
    assert not names & {*taken_out.without, *(effect.name for effect in taken_out.effects)}
