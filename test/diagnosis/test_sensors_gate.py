from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from types import SimpleNamespace
from typing import cast

import numpy as np
import pytest
import trial_faults as faults
from trial_drive import make_run

from truck_blowout_sim import read_recording
from truck_blowout_sim.diagnosis.sensors import correct, sensor_gate
from truck_blowout_sim.diagnosis.sensors import search as searching
from truck_blowout_sim.diagnosis.sensors.case import Case, Hypothesis
from truck_blowout_sim.diagnosis.sensors.distortions import Delay, LeverArm
from truck_blowout_sim.diagnosis.sensors.search import _sound_in_training, leaders_of_each_kind
from truck_blowout_sim.diagnosis.sensors.solve import Estimate
from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings import Recording, Series

RUNS = [make_run(20, 15.0), make_run(21, 15.0, steer=0.5)]
BASELINE = [make_run(22, 12.0)]
GYRO = ("roll_rate_radps", "pitch_rate_radps", "yaw_rate_radps")
INERTIAL = (*GYRO, "ax_mps2", "ay_mps2", "az_mps2")
# name, channel word, parameter, true value, tolerance, change
FAULTS = [
    ("yaw_rate_bias", "yaw_rate", "bias", np.radians(0.15), np.radians(0.02),
     lambda u: faults.offset(f"{u}_yaw_rate_radps", np.radians(0.15))),
    ("yaw_rate_scale", "yaw_rate", "scale_error", 0.03, 0.008,
     lambda u: faults.scaled(f"{u}_yaw_rate_radps", 0.03)),
    ("lateral_accel_scale", "ay", "scale_error", 0.10, 0.02,
     lambda u: faults.scaled(f"{u}_ay_mps2", 0.10)),
    ("lateral_accel_roll", "ay", "roll_leak", 0.5, 0.12, lambda u: faults.leaking(u, 0.5)),
    ("speed_scale", "vx", "scale_error", 0.015, 0.002,
     lambda u: faults.scaled(f"{u}_vx_mps", 0.015)),
    ("channel_delay", "yaw_rate", "delay", 0.05, 0.006,
     lambda u: faults.delayed([f"{u}_yaw_rate_radps"], 0.05)),
    ("channel_delay", "ay", "delay", 0.08, 0.008,
     lambda u: faults.delayed([f"{u}_{c}" for c in INERTIAL], 0.08)),
    ("lever_arm", "vy", "forward", 0.5, 0.12, lambda u: faults.displaced(u, 0.5, "velocity")),
    ("lever_arm", "ay", "forward", 0.5, 0.15,
     lambda u: faults.displaced(u, 0.5, "velocity accelerometer")),
    ("lever_arm", "x_m", "forward", 0.5, 0.1,
     lambda u: faults.displaced(u, 0.5, "velocity accelerometer position")),
]  # fmt: skip
IDS = [f"{name}-{word}" for name, word, *_ in FAULTS]


@pytest.mark.parametrize("unit", ["tractor", "trailer"])
@pytest.mark.parametrize(("name", "word", "parameter", "value", "tolerance", "change"), FAULTS,
                         ids=IDS)  # fmt: skip
def test_a_fault_is_named_placed_and_measured(
    unit: str, name: str, word: str, parameter: str, value: float, tolerance: float,
    change: object,
) -> None:  # fmt: skip
    assert callable(change)
    spoilt = [change(unit)(run) for run in RUNS]
    result = sensor_gate(spoilt, BASELINE)
    assert [finding.name for finding in result.findings] == [name]
    finding = result.findings[0]
    assert finding.body == unit
    assert any(word in channel for channel in finding.channels)
    amount = finding.parameters[parameter]
    assert amount.value == pytest.approx(value, abs=tolerance)
    # Four standard errors: the interval must not be too narrow for the error made.
    assert abs(amount.value - value) < 4.0 / 1.645 * (amount.ci90[1] - amount.ci90[0]) / 2.0
    assert finding.p_value < 1e-4
    assert not finding.in_baseline


def test_sound_runs_are_clean() -> None:
    result = sensor_gate(RUNS, BASELINE)
    assert result.clean
    assert result.broken == ()
    assert 0.6 < result.chi2 / result.rows < 1.1


def test_normal_mounting_errors_are_no_fault() -> None:
    def mounted(run: Recording) -> Recording:
        for unit, k in (("tractor", 1.0), ("trailer", 2.0)):
            for stem, error in (("yaw_rate_radps", np.radians(0.006)), ("ay_mps2", -0.006),
                                ("ax_mps2", 0.006), ("yaw_rad", np.radians(0.05)),
                                ("roll_rad", np.radians(-0.05))):  # fmt: skip
                run = faults.offset(f"{unit}_{stem}", 1.5 * k * error)(run)
        return run

    assert sensor_gate([mounted(run) for run in RUNS], [mounted(run) for run in BASELINE]).clean
    assert sensor_gate([mounted(run) for run in RUNS]).clean


def with_cheap_gyros(runs: list[Recording]) -> list[Recording]:
    """Ten times as noisy as the test instruments."""
    rng = np.random.default_rng(6)
    gyros = [f"{unit}_{stem}" for unit in ("tractor", "trailer") for stem in GYRO]
    return [faults.noisy(gyros, np.radians(0.2), rng)(run) for run in runs]


@pytest.mark.parametrize(("zero_degps", "named"), [(0.15, []), (2.0, ["yaw_rate_bias"])])
def test_the_zero_of_a_cheap_gyro_may_be_off_by_as_much_as_its_noise(
    zero_degps: float, named: list[str]
) -> None:
    change = faults.offset("tractor_yaw_rate_radps", np.radians(zero_degps))
    result = sensor_gate(with_cheap_gyros([change(run) for run in RUNS]),
                         with_cheap_gyros(BASELINE))
    assert [finding.name for finding in result.findings] == named


def test_cheap_gyros_do_not_hide_a_gain_of_the_accelerometer() -> None:
    change = faults.scaled("tractor_ay_mps2", 0.2)
    result = sensor_gate(with_cheap_gyros([change(run) for run in RUNS]),
                         with_cheap_gyros(BASELINE))
    assert [finding.name for finding in result.findings] == ["lateral_accel_scale"]
    assert result.findings[0].p_value < 1e-6


def test_each_kind_of_fault_is_tried_at_its_own_optimum() -> None:
    """However little its first, linear step gains."""
    arms = [Hypothesis(LeverArm("lever_arm", unit, "", (f"{unit}_{c}",)), everywhere=False)
            for unit in ("tractor", "trailer") for c in ("vx_mps", "vy_mps", "ax_mps2")]
    late, later = (Hypothesis(Delay("channel_delay", unit, "", (f"{unit}_ay_mps2",)),
                              everywhere=False) for unit in ("tractor", "trailer"))
    assert leaders_of_each_kind([*arms, late, later], 6) == [*arms[:4], late]
    assert leaders_of_each_kind([late, *arms, later], 1) == [late, arms[0]]


def test_two_faults_at_once() -> None:
    late = faults.delayed([f"trailer_{c}" for c in INERTIAL], 0.06)
    spoilt = [late(faults.scaled("tractor_yaw_rate_radps", -0.04)(run)) for run in RUNS]
    result = sensor_gate(spoilt, BASELINE)
    assert {(f.name, f.body) for f in result.findings} == {
        ("yaw_rate_scale", "tractor"), ("channel_delay", "trailer"),
    }  # fmt: skip


def test_what_only_the_baseline_has_is_no_fault_of_training() -> None:
    """An arm in every run and its opposite in training: the training runs are sound."""
    arm = LeverArm("lever_arm", "trailer", "trailer velocity", ("trailer_vx_mps",), ("forward",))
    late = Delay("channel_delay", "tractor", "", ("tractor_ay_mps2",))
    chosen = [Hypothesis(arm, everywhere=True), Hypothesis(late, everywhere=False),
              Hypothesis(arm, everywhere=False)]
    kept = {}
    for opposite in (0.76, 0.3):
        estimate = cast("Estimate", SimpleNamespace(
            amounts=((-0.84,), (0.1,), (opposite,)), covariance=np.diag([2e-3, 1e-6, 2e-3])))
        kept[opposite] = _sound_in_training(chosen, estimate)
    assert kept == {0.76: [chosen[1]], 0.3: chosen}


def test_a_fault_of_every_run_shows_without_a_baseline() -> None:
    result = sensor_gate([faults.scaled("tractor_ay_mps2", 0.12)(run) for run in RUNS])
    assert [finding.name for finding in result.findings] == ["lateral_accel_scale"]
    assert result.findings[0].parameters["scale_error"].value == pytest.approx(0.12, abs=0.02)


@pytest.mark.parametrize("gain", [-0.6, 0.6])
def test_a_gain_that_is_off_by_more_than_half_is_measured(gain: float) -> None:
    result = sensor_gate([faults.scaled("tractor_ay_mps2", gain)(run) for run in RUNS], BASELINE)
    assert [finding.name for finding in result.findings] == ["lateral_accel_scale"]
    assert result.findings[0].parameters["scale_error"].value == pytest.approx(gain, abs=0.05)


def test_what_explains_all_but_a_twentieth_is_an_alias() -> None:
    """Gravity that leaks through a noisy roll angle looks like a gain."""
    rng = np.random.default_rng(5)

    def leaking(run: Recording) -> Recording:
        run = faults.leaking("tractor", 0.5)(run)
        roll = run["tractor_roll_rad"]
        noisy = roll.value + rng.normal(0.0, 0.3 * np.std(roll.value), roll.value.size)
        return run.with_channels({"tractor_roll_rad": Series(roll.time_s, noisy)})

    found = sensor_gate([leaking(run) for run in RUNS], BASELINE).findings
    assert "lateral_accel_roll" in {name for one in found for name in one.aliases}


def test_without_roll_a_leak_and_a_gain_are_aliases() -> None:
    def free_of_gravity(run: Recording) -> Recording:
        for unit in ("tractor", "trailer"):
            run = faults.leaking(unit, -1.0)(run)
        return run.with_metadata(accelerometers="gravity removed").without_channels(
            [f"{unit}_{name}" for unit in ("tractor", "trailer")
             for name in ("roll_rad", "pitch_rad", "az_mps2")]
        )

    spoilt = [faults.scaled("tractor_ay_mps2", 0.12)(free_of_gravity(run)) for run in RUNS]
    names = [finding.aliases for finding in sensor_gate(spoilt).findings]
    assert len(names) == 1
    assert set(names[0]) >= {"lateral_accel_scale", "lateral_accel_roll"}


def test_speed_without_a_second_opinion_stays_open() -> None:
    stems = ("vx_mps", "vy_mps", "yaw_rate_radps", "ay_mps2", "roll_rad", "roll_rate_radps")
    kept = [f"tractor_{stem}" for stem in stems]
    spoilt = [faults.scaled("tractor_vx_mps", 0.04)(run).only_channels(kept) for run in RUNS]
    findings = sensor_gate(spoilt).findings
    assert len(findings) == 1
    assert {"speed_scale", "yaw_rate_scale"} <= set(findings[0].aliases)
    assert "position" in findings[0].next_test


def test_a_blowout_that_shakes_the_truck_is_no_sensor_fault(shared_recordings: Path) -> None:
    run = read_recording(shared_recordings / "proving_ground" / "nominal" / "blowout.csv")
    assert run.blowouts
    assert sensor_gate([run]).clean


def sample_cases(root: Path) -> Iterator[tuple[list[Recording], list[Recording]]]:
    ground = root / "proving_ground"
    nominal = [read_recording(p) for p in sorted((ground / "nominal").glob("*.csv"))]
    sample = {
        p.stem: read_recording(p) for p in sorted((ground / "concealed_sample").glob("*.csv"))
    }
    baseline = [r for name, r in sample.items() if name.startswith("baseline")]
    yield nominal, []
    yield [r for name, r in sample.items() if not name.startswith("baseline")], baseline
    yield list(sample.values()), []


def test_sound_sample_recordings_are_clean(shared_recordings: Path) -> None:
    for recordings, baseline in sample_cases(shared_recordings):
        result = sensor_gate(recordings, baseline)
        assert result.clean, [finding.sentence for finding in result.findings]
        assert result.broken == ()


def test_a_car_without_a_trailer_is_answered(shared_recordings: Path) -> None:
    run = read_recording(shared_recordings / "stanford_250lm" / "first_half.csv")
    result = sensor_gate([run])
    assert {r.identity for r in result.identities} == {
        "tractor lateral acceleration", "tractor longitudinal acceleration",
    }  # fmt: skip
    assert any("roll not recorded" in note for note in result.notes)
    lateral = next(r for r in result.identities if "lateral" in r.identity)
    assert 0.15 < lateral.rms < 0.4, "vibration and roll, 0.4 s means"


def test_corrected_runs_are_clean() -> None:
    spoilt = [faults.delayed(["tractor_yaw_rate_radps"], 0.07)(run) for run in RUNS]
    findings = sensor_gate(spoilt, BASELINE).findings
    mended = [correct(run, findings) for run in spoilt]
    assert sensor_gate(mended, BASELINE).clean


def test_same_runs_same_answer() -> None:
    spoilt = [faults.scaled("trailer_ay_mps2", 0.1)(run) for run in RUNS]
    first, second = sensor_gate(spoilt), sensor_gate(spoilt)
    assert first.findings == second.findings
    assert first.chi2 == second.chi2


def test_bad_input_is_refused_in_one_line() -> None:
    with pytest.raises(ValueError, match="at least one"):
        sensor_gate([])
    time_s = np.arange(0.0, 5.0, 0.01)
    empty = Recording("still.csv", {"throttle": Series(time_s, np.zeros(time_s.size))})
    with pytest.raises(InputError, match=r"still\.csv: no motion channel"):
        sensor_gate([empty])


def test_what_a_refused_hypothesis_explains_better_is_not_named(
    monkeypatch: pytest.MonkeyPatch
) -> None:
    """A delay that may be chance is no reason to believe in a lever arm that explains less."""
    late = faults.delayed([f"trailer_{c}" for c in INERTIAL], 0.06)
    spoilt = [late(run) for run in RUNS]
    assert [f.name for f in sensor_gate(spoilt, BASELINE).findings] == ["channel_delay"]
    usual = searching.chances

    def doubtful(case: Case, chosen: Sequence[Hypothesis], amounts: Sequence[Sequence[float]],
                 inflation: Mapping[str, float]) -> list[float]:
        return [1.0 if isinstance(h.distortion, Delay) else p
                for h, p in zip(chosen, usual(case, chosen, amounts, inflation), strict=True)]

    monkeypatch.setattr(searching, "chances", doubtful)
    assert sensor_gate(spoilt, BASELINE).findings == ()
