"""The plainest law: the variable that made the force history is found."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from truck_blowout_sim.diagnosis.answer.words import verdict_sentence
from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.locate.wrench import Wrenches
from truck_blowout_sim.diagnosis.model.law import Law, _left_out, plainest_law
from truck_blowout_sim.diagnosis.model.law_check import checked
from truck_blowout_sim.diagnosis.result.evidence import ForceHistory
from truck_blowout_sim.recordings import Recording, Series
from truck_blowout_sim.vehicle import Packed

Studies = Callable[..., Study]

TIMES = np.arange(0.5, 20.0)
SPEED = 25.0 - 0.7 * TIMES
YAW_RATE = 0.1 * np.sin(TIMES)


def run_with(**channels: np.ndarray) -> SimpleNamespace:
    recording = Recording("r", {n: Series(TIMES, v) for n, v in channels.items()})
    return SimpleNamespace(recording=recording)


def history(fx: np.ndarray, fy: np.ndarray) -> Wrenches:
    rng = np.random.default_rng(3)
    one = np.full(TIMES.size, 60.0)
    noisy = [f + rng.normal(0.0, 60.0, TIMES.size) for f in (fx, fy)]
    forces = ForceHistory("r", "trailer", TIMES, noisy[0], noisy[1], np.zeros(TIMES.size), one, one,
                          10.0 * one)
    return Wrenches(forces, 1.0, 900.0, 60, 0.0, 1.0)


@pytest.mark.parametrize(("fx", "fy", "variable", "factor"), [
    (-80.0 * SPEED, 0.0 * SPEED, "v", -80.0),
    (-4.0 * SPEED**2, 0.0 * SPEED, "v^2", -4.0),
    (0.0 * SPEED, 900.0 * SPEED * YAW_RATE, "v r", 900.0),
    (0.0 * SPEED, np.where(TIMES > 12.0, 2500.0, 0.0), "1 (constant while it acts)", 2500.0),
])
def test_finds_the_variable_that_made_the_force(
    fx: np.ndarray, fy: np.ndarray, variable: str, factor: float
) -> None:
    law = plainest_law(history(fx, fy), run_with(tractor_vx_mps=SPEED,
                                                 tractor_yaw_rate_radps=YAW_RATE))
    (name, found), = law.terms
    assert name == variable
    assert f"{found:.4g} {'(constant' if variable[0] == '1' else f'* {variable}'}" in law.equation
    assert "* 1" not in law.equation
    assert found == pytest.approx(factor, rel=0.1)
    assert law.explained > 0.8


def test_two_terms_where_both_are_there_and_one_where_one_is() -> None:
    roll = 0.03 * np.cos(0.7 * TIMES)
    channels = {"trailer_vx_mps": SPEED, "trailer_yaw_rate_radps": YAW_RATE,
                "trailer_roll_rad": roll}
    both = plainest_law(history(0.0 * SPEED, 900.0 * SPEED * YAW_RATE - 60e3 * roll),
                        run_with(**channels))
    assert dict(both.terms) == {"v r": pytest.approx(900.0, rel=0.1),
                                "phi": pytest.approx(-60e3, rel=0.1)}
    assert both.equation.startswith("F_y,trailer = -6.0")
    assert " * phi + 9" in both.equation
    assert both.explained > 0.9
    assert set(both.values) == {"unit.trailer.probe_fy_vr_kg", "unit.trailer.probe_fy_roll_nprad"}
    one = plainest_law(history(0.0 * SPEED, -60e3 * roll), run_with(**channels))
    assert [name for name, _ in one.terms] == ["phi"]


def test_what_the_model_has_no_place_for_is_said_and_not_added() -> None:
    throttle = 0.5 + 0.5 * np.sin(1.3 * TIMES)
    law = plainest_law(history(3000.0 * throttle, 0.0 * SPEED), run_with(throttle=throttle))
    assert [name for name, _ in law.terms] == ["throttle"]
    assert not law.values
    assert not law.helps
    sentence = verdict_sentence("unknown", (), (), law)
    assert "the model has no place for it" in sentence


def test_left_out_windows_are_predicted_as_by_leaving_them_out() -> None:
    rng = np.random.default_rng(8)
    design, value = rng.normal(size=(15, 2)), rng.normal(size=15)
    total = 0.0
    for k in range(15):
        kept = np.arange(15) != k
        factors = np.linalg.lstsq(design[kept], value[kept], rcond=None)[0]
        total += float((value[k] - design[k] @ factors) ** 2)
    assert _left_out(design, value) == pytest.approx(total, rel=1e-9)


def test_a_law_is_tried_on_runs_that_were_never_fitted(study_of: Studies, truck: Packed) -> None:
    """A side force in proportion to yaw rate times speed, in training and in the unseen run."""
    key = "unit.trailer.probe_fy_vr_kg"
    study = study_of({key: 4000.0}, holdout={key: 4000.0}, baseline=True)
    law = Law("trailer", (("v r", 4000.0),), "F_y = 4000 v r", 0.9, {key: 4000.0})
    right, wrong = (checked(study, replace(law, values={key: k})) for k in (4000.0, -4000.0))
    assert right.unseen is not None
    assert right.unseen[1] < 0.5 * right.unseen[0]
    assert right.helps
    assert "percent better" in verdict_sentence("unknown", (), (), right)
    assert not wrong.helps
    assert "so it is not added" in verdict_sentence("unknown", (), (), wrong)


def test_a_constant_force_can_be_put_into_the_model() -> None:
    law = plainest_law(history(0.0 * SPEED, np.where(TIMES > 12.0, 2500.0, 0.0)),
                       run_with(tractor_vx_mps=SPEED))
    assert law.values["unit.trailer.probe_start_s"] == pytest.approx(12.0, abs=1.1)
    assert law.values["unit.trailer.probe_fy_n"] == pytest.approx(2500.0, rel=0.1)


def test_pure_noise_is_hardly_explained() -> None:
    law = plainest_law(history(0.0 * SPEED, 0.0 * SPEED), run_with(tractor_vx_mps=SPEED))
    assert law.explained < 0.4
