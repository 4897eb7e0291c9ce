"""Data that the algebra cannot use are bad input."""

from __future__ import annotations

import numpy as np
import pytest

from truck_blowout_sim.diagnosis.case.usable import determined
from truck_blowout_sim.errors import InputError


@determined
def solved(matrix: np.ndarray) -> np.ndarray:
    """Solve for ones."""
    return np.linalg.solve(matrix, np.ones(len(matrix)))


def test_a_singular_system_is_one_line_of_bad_input() -> None:
    with pytest.raises(InputError, match="do not determine a solution"):
        solved(np.zeros((2, 2)))


def test_other_mistakes_stay_what_they_are() -> None:
    with pytest.raises(TypeError):
        determined(len)(1)  # type: ignore[arg-type]
