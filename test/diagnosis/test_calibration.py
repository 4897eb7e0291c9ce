"""The reference moves to what the runs ask for; amounts go on counting from the sheet."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace

import numpy as np
import pytest

from truck_blowout_sim.diagnosis.case import memory
from truck_blowout_sim.diagnosis.case.calibration import calibrate
from truck_blowout_sim.diagnosis.case.memory import check_memory, sensitivities_bytes
from truck_blowout_sim.diagnosis.case.study import Study, build_columns
from truck_blowout_sim.errors import InputError
from truck_blowout_sim.vehicle import Packed

Studies = Callable[..., Study]
HEAVY = 1.06


def heavy(truck: Packed) -> Mapping[str, float]:
    return {"unit.trailer.mass_kg": HEAVY * truck["unit.trailer.mass_kg"]}


def posterior(study: Study) -> dict[str, float]:
    amounts = study.projector().amounts(study.residual())
    return {study.names[k]: float(a) for k, a in zip(study.kept(), amounts, strict=True)}


def test_a_heavy_trailer_is_found_and_counts_from_the_sheet(
    study_of: Studies, truck: Packed
) -> None:
    study = study_of(heavy(truck))
    sigma = next(n.sigma for n in study.settings.nuisances if n.name == "trailer_mass")
    wanted = (HEAVY - 1.0) / sigma
    assert posterior(study)["trailer_mass"] == pytest.approx(wanted, rel=0.25)
    moved = study.packed["unit.trailer.mass_kg"] / truck["unit.trailer.mass_kg"]
    assert moved == pytest.approx(1.0 + study.amounts["trailer_mass"] * sigma)


def test_moving_the_reference_explains_no_worse_than_the_columns(
    study_of: Studies, truck: Packed
) -> None:
    study = study_of(heavy(truck))
    per_row = study.projector().chi2(study.residual()) / study.columns.shape[0]
    assert per_row < 1.1
    clean = study.residual() - study.columns @ np.array([posterior(study)[n] for n in study.names])
    assert np.sqrt(np.mean(clean**2)) < 1.1


def test_sensitivities_are_those_of_the_truck_that_baseline_runs_show(
    study_of: Studies, truck: Packed
) -> None:
    soft = {"steering.stiffness_nmprad": 0.5 * truck["steering.stiffness_nmprad"]}
    study = study_of(soft, baseline=soft)
    assert max(abs(amount) for amount in study.amounts.values()) > 0.1
    before = study.columns
    build_columns(study)
    np.testing.assert_allclose(study.columns, before, atol=1e-9)


def test_a_sensitivity_counts_in_sigmas_of_the_sheet_wherever_the_truck_is(
    study_of: Studies, truck: Packed
) -> None:
    study, name, here, little = study_of(), "trailer_mass", 4.0, 0.5
    number = next(n for n in study.settings.nuisances if n.name == name)
    study.packed = truck.with_values(number.values(truck, here * number.sigma))
    study.amounts = {name: here}
    study.update_models()
    build_columns(study)
    run = study.runs[0]
    near = truck.with_values(number.values(truck, (here + little) * number.sigma))
    change = run.change(run.simulated(near), study.models[0])
    column = study.columns[:run.measured.size, study.names.index(name)]
    assert np.linalg.norm(change - little * column) < 0.02 * np.linalg.norm(change)


def test_only_baseline_runs_say_what_is_usual(study_of: Studies, truck: Packed) -> None:
    assert study_of(heavy(truck)).expected("trailer_mass") == 0.0
    with_baseline = study_of(baseline=True)
    assert with_baseline.expected("trailer_mass") == with_baseline.amounts["trailer_mass"]
    assert abs(with_baseline.expected("trailer_mass")) < 1.0


def test_a_shift_lowers_the_model_by_so_many_sigmas(study_of: Studies) -> None:
    study = study_of()
    run = study.runs[0]
    lower = run.shifted(np.full(run.measured.size, 2.0))
    before, after = (one.residual(one.simulated(study.packed)) for one in (run, lower))
    known = np.isfinite(run.measured).ravel()
    np.testing.assert_allclose((after - before)[known], 2.0, rtol=1e-9)


def test_a_number_is_known_where_baseline_runs_show_it(study_of: Studies) -> None:
    assert study_of().known == frozenset()
    known = study_of(baseline=True).known
    assert "steering_zero" in known
    assert known <= {n.name for n in study_of().settings.nuisances}


def test_more_runs_than_memory_holds_are_refused_with_their_size(
    study_of: Studies, monkeypatch: pytest.MonkeyPatch
) -> None:
    study = study_of(holdout={}, baseline=True)
    unseen = sum(columns.nbytes for columns in study.holdout_columns)
    assert sensitivities_bytes(study) == study.columns.nbytes + unseen
    twice = replace(study, runs=study.runs * 2, holdout=study.holdout * 2)
    assert sensitivities_bytes(twice) > 2 * sensitivities_bytes(study)
    check_memory(study)
    monkeypatch.setattr(memory, "machine_bytes", lambda: 1_000_000)
    with pytest.raises(InputError, match=r"3 runs need about 0\.\d+ GB.* the 0\.001 GB of this"):
        calibrate(study)
    monkeypatch.setattr(memory, "machine_bytes", lambda: None)  # a system that does not say
    check_memory(study)
