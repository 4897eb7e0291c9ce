"""The vehicle that is written goes no farther from its sheet than simulation confirms."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
import pytest
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.case.simulations import Job
from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.model import vehicle
from truck_blowout_sim.diagnosis.model.vehicle import diagnosed_truck
from truck_blowout_sim.vehicle import Packed

Floats = NDArray[np.float64]
Studies = Callable[..., Study]
MASS = "unit.trailer.mass_kg"


def test_a_heavier_trailer_is_written_with_its_source(study_of: Studies, truck: Packed) -> None:
    study = study_of({MASS: 1.03 * truck[MASS]})
    one = diagnosed_truck(study, truck, study.models, ())
    assert 0.005 < one.packed[MASS] / truck[MASS] - 1.0 < 0.06
    assert "prior sigmas from the sheet" in one.sources[MASS]
    assert all(one.sources.values())


def test_where_driving_confirms_nothing_the_reference_stays(
        study_of: Studies, truck: Packed, monkeypatch: pytest.MonkeyPatch) -> None:
    study = study_of({MASS: 1.03 * truck[MASS]})
    usual, asked = vehicle._left, []

    def never_better(study: Study, *given: object) -> float:
        asked.append(usual(study, *given))  # type: ignore[arg-type]
        return float(len(asked))

    monkeypatch.setattr(vehicle, "_left", never_better)
    one = diagnosed_truck(study, truck, study.models, ())
    assert one.packed[MASS] == truck[MASS]
    assert len(asked) == 3  # the reference, all of the way, half of it
    assert asked[1] < asked[0]  # in truth the first step helps


def test_no_truck_is_written_that_cannot_be_driven_over_an_unseen_run(
        study_of: Studies, truck: Packed, monkeypatch: pytest.MonkeyPatch) -> None:
    study = study_of({MASS: 1.03 * truck[MASS]}, holdout={MASS: 1.03 * truck[MASS]})
    assert diagnosed_truck(study, truck, study.models, ()).packed[MASS] > truck[MASS]
    drive = Study.simulate

    def lost(study: Study, jobs: Sequence[Job]) -> list[Floats]:
        return [np.full_like(model, np.nan)
                if run.role == "holdout" and changed[MASS] > truck[MASS] else model
                for model, (run, changed) in zip(drive(study, jobs), jobs, strict=True)]

    monkeypatch.setattr(Study, "simulate", lost)
    assert diagnosed_truck(study, truck, study.models, ()).packed[MASS] == truck[MASS]
