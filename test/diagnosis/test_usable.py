"""Data that the algebra cannot use are bad input."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from truck_blowout_sim.diagnosis import QUICK, calibrate, diagnose
from truck_blowout_sim.diagnosis.case.names import names_apart
from truck_blowout_sim.diagnosis.case.usable import check_each_once, determined
from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings import Recording, Series


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


def run_of(name: str, speed_mps: float) -> Recording:
    return Recording(name, {"tractor_vx_mps": Series(np.arange(3.0), np.full(3, speed_mps))})


def test_a_run_in_two_roles_is_refused_under_whatever_name() -> None:
    a, b, copy = run_of("a", 20.0), run_of("b", 21.0), run_of("copy", 20.0)
    check_each_once({"fitted": [a], "only predicted": [b]})
    for roles in ({"fitted": [a], "only predicted": [b, copy]}, {"fitted": [a, copy]}):
        with pytest.raises(InputError, match="copy: is given twice: fitted as a"):
            check_each_once(roles)


@pytest.mark.parametrize("use", [diagnose, calibrate])
def test_a_fitted_run_does_not_prove_itself(use: Callable[..., object]) -> None:
    run = run_of("a", 20.0)
    with pytest.raises(InputError, match="is given twice: fitted as a, only predicted as a"):
        use([run], holdout=[run])


def test_runs_of_one_name_get_names_of_their_own_over_all_roles() -> None:
    runs = [run_of(name, 20.0) for name in ("drive", "drive (2)", "drive", "other", "drive")]
    fitted, calm, unseen = names_apart(runs[:2], runs[2:4], runs[4:])
    assert [[run.name for run in group] for group in (fitted, calm, unseen)] == [
        ["drive", "drive (2)"], ["drive (3)", "other"], ["drive (4)"]]
    assert fitted[0] is runs[0]
    assert calm[1] is runs[3]


def test_a_diagnosis_tells_runs_of_one_name_apart(drive_it: Callable[..., Recording]) -> None:
    calm, asked = drive_it(seed=5, name="drive"), drive_it(seed=1, name="drive")
    answer, _ = diagnose([asked], baseline=[calm], effort=QUICK, workers=1)
    assert sorted(answer.evidence.recordings) == [("drive", "train"), ("drive (2)", "baseline")]
    assert {force.recording for force in answer.evidence.forces} == {"drive"}
