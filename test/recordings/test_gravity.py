"""What a recording says of gravity in its accelerations."""

from __future__ import annotations

import numpy as np
import pytest

from truck_blowout_sim.recordings import Recording
from truck_blowout_sim.recordings.gravity import (
    AT_REST_MPS2,
    gravity_felt,
    gravity_is_removed,
    with_gravity_stated,
)

SAID = Recording("run", {}).with_metadata(accelerometers="Gravity removed by the INS")


def test_without_a_word_accelerations_contain_gravity() -> None:
    assert not gravity_is_removed(Recording("run", {}), "tractor")


def test_one_line_speaks_of_all_units_and_another_of_one() -> None:
    assert gravity_is_removed(SAID, "tractor")
    one = with_gravity_stated(SAID, "trailer", removed=False)
    assert gravity_is_removed(one, "tractor")
    assert not gravity_is_removed(one, "trailer")
    assert gravity_is_removed(with_gravity_stated(one, "trailer", removed=True), "trailer")


@pytest.mark.parametrize(("roll", "pitch"), [(0.0, 0.0), (0.1, -0.05), (-1.2, 0.4)])
def test_a_leaning_body_feels_one_gravity_in_all(roll: float, pitch: float) -> None:
    felt = np.array([gravity_felt(stem, np.array(roll), np.array(pitch))
                     for stem in ("ax_mps2", "ay_mps2", "az_mps2")])
    assert np.linalg.norm(felt) == pytest.approx(AT_REST_MPS2)
    assert np.sign(felt[1]) == np.sign(roll)
    assert np.sign(felt[0]) == -np.sign(pitch)
