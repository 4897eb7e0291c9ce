"""From evidence to answer: verdicts, intervals, aliases, location."""

from __future__ import annotations

import sys
from collections.abc import Callable
from dataclasses import replace
from types import SimpleNamespace
from typing import cast

import numpy as np
import pytest

from truck_blowout_sim.diagnosis.answer import words
from truck_blowout_sim.diagnosis.answer.cautions import cautions
from truck_blowout_sim.diagnosis.answer.location import locate
from truck_blowout_sim.diagnosis.answer.material import Material
from truck_blowout_sim.diagnosis.answer.outcome import answer
from truck_blowout_sim.diagnosis.answer.told import alias_set, physics_effect, sensor_effects
from truck_blowout_sim.diagnosis.answer.verdict import decide
from truck_blowout_sim.diagnosis.case.recorded import Recorded
from truck_blowout_sim.diagnosis.case.runs import Run
from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.diagnose import _diagnosed, _with_truck
from truck_blowout_sim.diagnosis.effects import LIBRARY
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.fit.ranked import Ranked
from truck_blowout_sim.diagnosis.fit.scatter import Chance, Scatter
from truck_blowout_sim.diagnosis.fit.shown import SCATTERS
from truck_blowout_sim.diagnosis.locate.beat import Beat
from truck_blowout_sim.diagnosis.locate.lagging import Lag
from truck_blowout_sim.diagnosis.locate.posture import Posture
from truck_blowout_sim.diagnosis.locate.restless import Restless, Unrest
from truck_blowout_sim.diagnosis.locate.wrench import Wrenches
from truck_blowout_sim.diagnosis.model.law import Law
from truck_blowout_sim.diagnosis.name.judging import Found, strongest_of
from truck_blowout_sim.diagnosis.name.trial import Fate, Trial
from truck_blowout_sim.diagnosis.prove.intervals import Timing
from truck_blowout_sim.diagnosis.result.evidence import BeatScores, ForceHistory
from truck_blowout_sim.diagnosis.result.summary import label_of
from truck_blowout_sim.diagnosis.sensors import GateResult, SensorFinding
from truck_blowout_sim.simulation.drive import run_drive
from truck_blowout_sim.simulation.plausible import DivergedError
from truck_blowout_sim.vehicle import Packed

Studies = Callable[..., Study]
NO_LAW = Law("trailer", (("1", 0.0),), "F_y = 0", 0.0, {})


def ranked(truck: Packed, name: str, amount: float, delta: float = 500.0, *, at: int = 0,
           sigma: float = 0.05, start_s: float | None = None) -> Ranked:
    effect = next(e for e in LIBRARY if e.name == name)
    place = effect.places(truck.vehicle)[at]
    times = {} if start_s is None else {"run 1": (start_s, start_s + 2.0)}
    return Ranked(Hypothesis(effect, place, amount, times), delta, sigma, True, delta)


def wrench(delta: float, body: str = "trailer") -> Wrenches:
    t = np.arange(0.5, 6.5)
    fy = np.where((t > 2.0) & (t < 4.0), 5000.0, 0.0)
    one = np.full(t.size, 200.0)
    history = ForceHistory("run 1", body, t, 0.0 * t, fy, 3.0 * fy, one, one, 5.0 * one)
    return Wrenches(history, 1.0, delta, 18, 3.0, 0.2)


def material(study: Study, named: tuple[Ranked, ...] = (), *, faults: int = 0,
             unnamed: float = 0.0) -> Material:
    chi2 = study.projector().chi2(study.residual())
    found = Found(named=list(named), rivals=[(r,) for r in named],
                  tried=[Trial(r, Fate("accepted")) for r in named], models_null=list(study.models),
                  chi2_null=chi2 + sum(r.delta for r in named), chi2_after=chi2)
    gate = cast(GateResult, SimpleNamespace(findings=("a faulty gyro",) * faults, notes=()))
    left = (wrench(unnamed),)
    return Material(study, found, gate, left, left, NO_LAW, {}, "a truck")


@pytest.fixture
def calm(study_of: Studies) -> Study:
    """A study of the true truck, as well explained as runs with nothing missing are."""
    return study_of()


@pytest.fixture
def pushed(study_of: Studies) -> Study:
    """A study with a baseline, and a push in training that nothing named explains."""
    return study_of({"unit.trailer.probe_fy_n": 20000.0, "unit.trailer.probe_start_s": 2.0,
                     "unit.trailer.probe_end_s": 4.5}, baseline=True)


def test_verdicts_follow_what_was_found(calm: Study, truck: Packed) -> None:
    drag, zero = ranked(truck, "road_bank", 0.03), ranked(truck, "steering_angle_offset", 0.2)
    assert decide(material(calm)) == "consistent"
    assert decide(material(calm, (drag,))) == "missing_physics"
    assert decide(material(calm, (zero,))) == "sensor_artefact"
    assert decide(material(calm, faults=1)) == "sensor_artefact"
    assert decide(material(calm, (drag,), faults=1)) == "missing_physics"


def test_a_beat_that_baseline_runs_lack_is_unknown_unless_what_was_named_says_more(
    study_of: Studies, truck: Packed
) -> None:
    calm, beat = study_of(baseline=True), beats()
    alone = replace(material(calm), beat=beat)
    assert decide(alone) == "unknown"
    told = answer(alone)
    assert "once per wheel turn" in told.sentence
    assert told.evidence.equations[-1] == beat.equation
    assert told.evidence.beats is beat.scores
    weak, strong = (replace(material(calm, (ranked(truck, "road_bank", 0.03, delta),)), beat=beat)
                    for delta in (200.0, 500.0))
    assert decide(weak) == "unknown"
    assert decide(strong) == "missing_physics"
    assert "once per wheel turn" in answer(strong).sentence


def test_without_baseline_runs_a_wheel_that_beats_is_noted_only(calm: Study) -> None:
    """Every sound wheel has a runout and an unbalance."""
    alone = replace(material(calm), beat=beats())
    assert decide(alone) == decide(material(calm)) == "consistent"
    told = answer(alone)
    assert "wheel turn" not in told.sentence
    assert "Every sound wheel does so" in told.evidence.notes[0]


def test_a_run_that_begins_on_a_flat_tire_is_noted(calm: Study) -> None:
    run, *rest = calm.runs
    initial = replace(run.drive.initial, flat=(("steer_left", 2.0),))
    flat = replace(calm, runs=(replace(run, drive=replace(run.drive, initial=initial)), *rest))
    assert any("steer_left burst 2.00 s" in note for note in answer(material(flat)).evidence.notes)
    assert not any("burst" in note for note in answer(material(calm)).evidence.notes)


def beats() -> Beat:
    scores = BeatScores("turning", np.array([3.1, 3.2]), np.array([1.0, 20.0]), 8.0)
    return Beat("turning", 3.2, 20.0, 300.0, "tractor", "tractor_az_mps2", 0.1, 22.0, scores)


def test_training_that_keeps_more_than_baseline_is_unknown(pushed: Study, truck: Packed) -> None:
    left = pushed.projector().chi2(pushed.residual())
    named = ranked(truck, "blown_tire_drag", 0.5, 0.1 * left)
    assert decide(material(pushed)) == "unknown"
    assert decide(material(pushed, (named,))) == "unknown"
    swallowed = replace(named, evidence=2.0 * left)  # by what calibration ascribes to the sheet
    assert decide(material(pushed, (swallowed,))) == "missing_physics"


@pytest.mark.parametrize(("unseen_falls_to", "verdict"), [
    (1.0, "missing_physics"), (19.0, "unknown")])
def test_a_name_that_explains_most_of_unseen_runs_is_not_withheld(
    pushed: Study, truck: Packed, unseen_falls_to: float, verdict: str
) -> None:
    """Training keeps 10 of 12 squares a row, an unseen run of the same length some of 20."""
    assert len(pushed.baseline) == len(pushed.train) == 1
    size = pushed.runs[pushed.train[0]].measured.size
    study = replace(pushed, holdout=(pushed.runs[pushed.train[0]],))
    one = material(study, (ranked(truck, "blown_tire_drag", 0.5, 2.0 * size),))
    still = [1.0 if i in study.baseline else 12.0 for i in range(len(study.runs))]
    after = [1.0 if i in study.baseline else 10.0 for i in range(len(study.runs))]
    vars(one).update(squares=(*after, unseen_falls_to), squares_unnamed=(*still, 20.0))
    assert decide(one) == verdict


def test_what_a_name_leaves_is_said_with_the_run_that_keeps_most(
    pushed: Study, truck: Packed
) -> None:
    left = pushed.projector().chi2(pushed.residual())
    some = material(pushed, (ranked(truck, "blown_tire_drag", 0.5, 2.0 * left),))
    worst = pushed.runs[pushed.train[0]].recording.name
    (said,) = cautions(some)
    assert said.startswith(f"That is not all: {worst} still differs")
    assert said in answer(some).sentence
    vars(some).update(squares=(1.0,) * len(pushed.runs))
    assert cautions(some) == ()


def test_what_a_corrected_instrument_leaves_is_nothing_unknown(pushed: Study) -> None:
    assert decide(material(pushed, faults=1)) == "sensor_artefact"


def test_without_baseline_runs_a_gross_mismatch_is_said_and_blamed_on_nothing(
    study_of: Studies, truck: Packed
) -> None:
    """Instruments that drift leave as much as a force does."""
    def pushed_by(fy_n: float) -> Study:
        return study_of({"unit.trailer.probe_fy_n": fy_n, "unit.trailer.probe_start_s": 2.0,
                         "unit.trailer.probe_end_s": 4.5})
    assert decide(material(pushed_by(200.0))) == "consistent"
    assert cautions(material(pushed_by(200.0))) == ()
    gross = material(pushed_by(45000.0))
    assert decide(gross) == "miscalibrated"
    (said,) = cautions(gross)
    assert "Without baseline runs it cannot be told" in said


def test_a_sheet_number_far_off_is_a_miscalibration_and_named(
    study_of: Studies, truck: Packed
) -> None:
    heavy = study_of({"unit.trailer.mass_kg": 1.14 * truck["unit.trailer.mass_kg"]})
    one = material(heavy)
    assert decide(one) == "miscalibrated"
    name, amount = one.pulled[0]
    assert name == "trailer_mass"
    assert amount == pytest.approx(7.0, rel=0.3)


def test_a_name_from_the_parts_of_one_log_asks_for_a_baseline_run(
    calm: Study, truck: Packed
) -> None:
    named = (ranked(truck, "road_bank", 0.03),)
    parts = replace(calm, settings=replace(calm.settings, episode_s=2.0))
    assert words.ONE_LOG in cautions(material(parts, named))
    assert words.ONE_LOG not in cautions(material(calm, named))  # shorter than one episode
    assert words.ONE_LOG not in cautions(material(parts))


def test_chance_falls_with_evidence_and_stays_a_probability(calm: Study, truck: Packed) -> None:
    rate = calm.alarms_by_name
    chance = Chance(Scatter(np.eye(SCATTERS.size)[0]), 20.0, rate)

    def p_value(support: float) -> float:
        one = material(calm, (replace(ranked(truck, "road_bank", 0.03), support=support),))
        one.found.chance = chance
        one.found.strongest = strongest_of([trial.ranked for trial in one.found.tried])
        return one.found.p_value

    chances = [p_value(support) for support in (0.0, 5.0, chance.asked, 60.0)]
    assert chances[0] == pytest.approx(1.0)
    assert chances[2] == pytest.approx(rate)
    assert chances == sorted(chances, reverse=True)
    assert 0.0 < chances[-1] < 1e-9
    assert material(calm).found.p_value == 1.0  # nothing was searched


def test_an_effect_is_reported_in_its_own_unit_with_a_90_percent_interval(
    calm: Study, truck: Packed
) -> None:
    effect = physics_effect(ranked(truck, "brake_imbalance", -0.5, sigma=0.1), calm)
    ratio = effect.parameters["torque_ratio"]
    assert ratio.value == pytest.approx(0.5)
    wide = 1.645 * np.hypot(0.1, 0.5 * calm.settings.form_share)
    assert ratio.ci90 == pytest.approx((0.5 - wide, 0.5 + wide), rel=1e-6)
    assert effect.onset_s is None
    assert "50 percent" in effect.sentence
    gust = physics_effect(ranked(truck, "crosswind", 12.0, start_s=2.5), calm)
    assert gust.onset_s == 2.5
    length = gust.parameters["duration_s in run 1"]
    assert length.value == pytest.approx(2.0)
    assert length.ci90 == (-np.inf, np.inf)
    timed = {"run 1": Timing((2.4, 2.6), (1.8, 2.2))}
    known = physics_effect(ranked(truck, "crosswind", 12.0, start_s=2.5), calm, timed)
    assert known.onset_ci90_s == (2.4, 2.6)
    assert known.parameters["duration_s in run 1"].ci90 == (1.8, 2.2)
    assert "2.50 s" in gust.sentence


def test_an_alias_set_names_each_effect_once_best_first(truck: Packed) -> None:
    rivals = (ranked(truck, "axle_misalignment", 0.02, at=2),
              ranked(truck, "axle_misalignment", 0.02, at=3), ranked(truck, "road_bank", 0.02))
    found = alias_set(rivals)
    assert found.names == ("axle_misalignment", "road_bank")
    assert found.places[0] == str(rivals[0].hypothesis.place)
    assert found.splits == rivals[0].hypothesis.effect.splits


def test_a_location_is_given_where_a_wrench_is_clear_and_only_there(calm: Study) -> None:
    quiet = locate(material(calm, unnamed=1.0))
    assert (quiet.body, quiet.interval_s, quiet.wrench) == (None, None, None)
    found = locate(material(calm, unnamed=1e4))
    assert found.body == "trailer"
    assert found.interval_s == pytest.approx((2.0, 4.0))
    assert found.line_of_action_x_m == pytest.approx(3.0)
    assert found.line_of_action_ci90_m == pytest.approx((3.0 - 0.329, 3.0 + 0.329))
    assert found.wrench is not None
    assert found.wrench.fy_n == pytest.approx(5000.0)


def test_a_body_that_stands_turned_is_no_bank_of_the_road(calm: Study, truck: Packed) -> None:
    bank = ranked(truck, "road_bank", 0.03, delta=8000.0)
    turned = Posture("tractor", "pitch", -0.004, 0.0001, 1500.0, 90.0)
    both = replace(material(calm, (bank,)), posture=turned)
    assert decide(both) == "unknown"
    told = answer(both)
    assert told.effects == ()
    assert "tractor stands with its tail low by 0.23 deg" in told.sentence
    assert "height over every axle of the tractor" in told.next_test
    assert turned.equation in told.evidence.equations


def test_a_wheel_that_lags_is_no_drag_of_the_air(calm: Study, truck: Packed) -> None:
    drag = ranked(truck, "aerodynamic_drag", 1.0)
    lag = Lag("trailer_1_left", 0.002, 0.0002, 100.0)
    told = answer(replace(material(calm, (drag,)), lag=lag))
    assert told.verdict == "unknown"
    assert "hub trailer_1_left" in told.sentence
    assert told.next_test == lag.next_test


def test_a_channel_that_moves_on_is_of_no_list(calm: Study, truck: Packed) -> None:
    moving = Restless("trailer", "trailer_yaw_rate_radps", 0.003, 0.001, 900.0)
    told = answer(replace(material(calm), unrest=Unrest(moving, 1e-4)))
    assert told.verdict == "unknown"
    assert "trailer's yaw rate" in told.sentence
    assert told.next_test == moving.next_test
    assert moving.equation in told.evidence.equations
    lag = ranked(truck, "tire_relaxation", 2.0, delta=300.0)
    assert decide(replace(material(calm, (lag,)), unrest=Unrest(moving, 1e-4))) == "unknown"


def test_what_an_inexact_law_leaves_in_a_channel_is_no_other_effect(
    calm: Study, truck: Packed
) -> None:
    lost = ranked(truck, "secondary_blowout", 0.1, delta=1e6, start_s=2.0)
    moving = Restless("trailer", "trailer_yaw_rate_radps", 0.003, 0.001, 900.0)
    told = answer(replace(material(calm, (lost,)), unrest=Unrest(moving, 1e-4)))
    assert told.verdict == "missing_physics"
    assert "moves in a way" not in told.sentence


def test_what_is_unknown_is_to_be_looked_for(pushed: Study) -> None:
    told = answer(material(pushed, unnamed=1e5))
    assert told.verdict == "unknown"
    assert "the force on the trailer follows speed" in told.next_test


def test_one_fault_of_two_amounts_says_which_is_which() -> None:
    """A gyro's zero that the baseline shows, too, and has moved since."""
    def finding(everywhere: bool, amount: str = ": bias 0.3 deg/s") -> SensorFinding:
        return cast(SensorFinding, SimpleNamespace(
            name="yaw_rate_bias", body="tractor", instrument="tractor yaw rate", parameters={},
            channels=("tractor_yaw_rate_radps",), equation="r_measured = r + bias",
            sentence=f"The tractor yaw rate reads off by a constant{amount}.",
            in_baseline=everywhere))

    both = sensor_effects([finding(True), finding(False)])
    assert [effect.sentence for effect in both] == [
        "The tractor yaw rate reads off by a constant in every run: bias 0.3 deg/s.",
        "The tractor yaw rate reads off by a constant beyond that of the baseline: bias 0.3 deg/s."]
    assert len({label_of(effect, both) for effect in both}) == 2
    assert sensor_effects([finding(False)])[0].sentence == finding(False).sentence
    without_amount = sensor_effects([finding(True, ""), finding(False, "")])[0].sentence
    assert without_amount == "The tractor yaw rate reads off by a constant in every run."


def test_an_unknown_cause_takes_along_no_effect_that_it_does_not_name(
    pushed: Study, truck: Packed
) -> None:
    """Page, figures and vehicle are of the truck without what explains too little."""
    named = ranked(truck, "road_bank", 0.03, 0.01 * pushed.projector().chi2(pushed.residual()))
    null = list(pushed.models)
    pushed.models[1] = pushed.simulate([(pushed.runs[1], named.hypothesis.apply(
        pushed.packed, "run 1"))])[0]
    one = material(pushed, (named,))
    one.found.models_null = null
    told = answer(one)
    assert told.verdict == "unknown"
    assert not [c for c in told.evidence.candidates if c.accepted]
    assert told.evidence.candidates[0].reason == "helps, but the cause is unknown"
    without = replace(material(replace(pushed, models=null)), law=one.law)
    assert told.train == answer(without).train
    assert told.evidence.equations == answer(without).evidence.equations
    _, after = _diagnosed(one, truck)
    assert not [name for name in after.values if name.startswith("world.")]


def in_noise(run: Run, truck: Packed) -> dict[str, float]:
    """Rms of what a truck leaves of each channel, over the noise of the instrument."""
    z = (run.measured - run.bins_of(run_drive(truck, run.drive))) / run.noise
    return {name: float(np.sqrt(np.nanmean(z[:, k] ** 2))) for k, name in enumerate(run.channels)
            if np.isfinite(z[:, k]).any()}


def test_before_is_the_vehicle_as_given_also_beside_baseline_runs(
    study_of: Studies, truck: Packed
) -> None:
    """After are numbers of the sheet, starts and instruments fitted, too."""
    turned = {"steering.offset_rad": truck["steering.offset_rad"] + 0.06}
    study = study_of(turned, baseline=turned)
    assert study.amounts["steering_zero"] > 0.5  # the baseline has moved the reference
    told = answer(material(study))
    given = in_noise(study.runs[1], truck)
    worst = max(given, key=lambda name: given[name])
    assert given[worst] > 2.0
    assert told.train.before[worst] == pytest.approx(given[worst], rel=0.2)
    assert told.train.after[worst] < 0.7 * given[worst]


def test_where_the_vehicle_cannot_be_driven_the_figures_of_the_prediction_stay(
    study_of: Studies, truck: Packed, monkeypatch: pytest.MonkeyPatch
) -> None:
    def lost(*given: object, **more: object) -> None:
        raise DivergedError("unseen: the run left the range of the model")

    monkeypatch.setattr(sys.modules["truck_blowout_sim.diagnosis.diagnose"], "driven_fit", lost)
    one = material(study_of(holdout={}))
    case = cast(Recorded, SimpleNamespace(every=(), packed=truck, impose_speed=None, quanta={}))
    told = answer(material(study_of()))
    driven, _ = _with_truck(told, one, case, truck)
    assert driven.holdout == told.holdout
    assert driven.evidence.notes[-1].startswith("unseen: the run left the range of the model")
