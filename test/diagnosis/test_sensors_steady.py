"""Whether a fault shows alike in every stretch: moderated variances, rough logs, real faults."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import trial_faults as faults
from numpy.typing import NDArray
from scipy.signal import lfilter
from trial_drive import make_run

from truck_blowout_sim.diagnosis.algebra.independent import independent_among
from truck_blowout_sim.diagnosis.sensors import sensor_gate
from truck_blowout_sim.diagnosis.sensors.case import make_case
from truck_blowout_sim.diagnosis.sensors.solve import noise_inflation
from truck_blowout_sim.diagnosis.sensors.steady import chances, color_of, moderated
from truck_blowout_sim.diagnosis.sensors.system import assemble
from truck_blowout_sim.recordings import Recording, Series

MEMORY_S, TIMES = 1.5, 8.0


def rough(run: Recording, seed: int) -> Recording:
    """The run with noise on every rate and velocity that remembers 1.5 s."""
    rng = np.random.default_rng(seed)
    sizes = {"_radps": np.radians(0.02), "_mps": 0.012, "_mps2": 0.03}
    changed = {}
    for name, series in run.channels.items():
        size = next((s for end, s in sizes.items() if name.endswith(end)), 0.0)
        if size and name.startswith(("tractor", "trailer")):
            colored = TIMES * size * faults.remembering(series.time_s, MEMORY_S, rng)
            changed[name] = Series(series.time_s, series.value + colored)
    return run.with_channels(changed)


@pytest.mark.parametrize(("factor", "degrees"), [(1.0, 4.0), (6.0, 10.0)])
def test_common_factor_and_degrees_are_found_in_ratios_of_variances(
    factor: float, degrees: float
) -> None:
    rng = np.random.default_rng(3)
    own: NDArray[np.float64] = np.full(4000, 6.0)
    ratio = factor * rng.f(6.0, degrees, own.size)
    found = moderated(ratio, own)
    assert found.factor == pytest.approx(factor, rel=0.1)
    assert found.degrees == pytest.approx(degrees, rel=0.2)


def test_noise_as_modeled_leaves_the_model_certain() -> None:
    ratio = np.random.default_rng(4).chisquare(6.0, 4000) / 6.0
    found = moderated(ratio, np.full(4000, 6.0))
    assert found.factor == pytest.approx(1.0, abs=0.05)
    assert found.degrees > 200.0


def test_alike_questions_are_one_and_different_ones_are_many() -> None:
    assert independent_among(np.ones((5, 5))) == pytest.approx(1.0)
    assert independent_among(np.diag([1.0, 4.0, 9.0])) == pytest.approx(3.0)


@pytest.mark.parametrize("seed", range(3))
def test_a_rough_log_without_a_fault_is_given_no_fault(seed: int) -> None:
    runs = [rough(make_run(40 + 10 * seed + k, 15.0), 7 * seed + k) for k in range(2)]
    assert not sensor_gate(runs, [rough(make_run(60 + seed, 12.0), 70 + seed)]).findings


def test_a_large_fault_is_named_in_a_rough_log() -> None:
    change = faults.offset("tractor_yaw_rate_radps", np.radians(2.0))
    runs = [change(rough(make_run(80 + k, 15.0), k)) for k in range(3)]
    found = sensor_gate(runs, [rough(make_run(90, 12.0), 9)]).findings[0]
    assert (found.name, found.body) == ("yaw_rate_bias", "tractor")
    assert found.parameters["bias"].value == pytest.approx(np.radians(2.0), rel=0.1)


def test_how_far_normal_errors_reach_says_nothing_of_how_a_log_scatters() -> None:
    """A wide prior is no noise of the rows: it may not make the other questions' scatter large."""
    change = faults.scaled("tractor_ay_mps2", 0.3)
    runs = [change(rough(make_run(20 + k, 15.0, steer=0.5 * k), 1 + k)) for k in range(2)]
    case = make_case(runs, [rough(make_run(22, 12.0), 3)], None)
    wide = replace(case, usual=tuple(
        replace(one, usual=tuple(1000.0 * u for u in one.usual))
        if one.distortion.name == "yaw_rate_bias" else one for one in case.usual))
    gain = next(h for h in case.hypotheses
                if h.distortion.name == "lateral_accel_scale" and not h.everywhere)
    logs = [np.log10(chances(one, [gain], [(0.3,)], noise_inflation(assemble(one)))[0])
            for one in (case, wide)]
    assert logs[0] < -2.0
    assert logs[0] == pytest.approx(logs[1], rel=0.05)


def test_a_tone_and_a_memory_are_taken_out_and_white_noise_is_left_as_it_is() -> None:
    """What any later part of the log could be foretold by is no sign of a fault."""
    rng, t = np.random.default_rng(5), 0.1 * np.arange(400)
    white = rng.standard_normal(t.size)
    assert color_of([white]).surprise[0, -1] > 0.95
    for loud in (3.0 * np.sin(2.0 * np.pi * 1.16 * t) + white,
                 lfilter([1.0], [1.0, -0.9], white)):
        left = color_of([loud]).whitened(loud[:, None])[:, 0]
        assert left.std() == pytest.approx(loud.std(), rel=0.25)  # its level stays
        assert abs(np.corrcoef(left[1:], left[:-1])[0, 1]) < 0.1


def test_a_zero_that_drifts_over_minutes_is_no_fault_and_one_that_stays_is() -> None:
    """Stretches of five seconds alone would take the mean of a drift for a constant."""
    size = np.radians(0.02)

    def long_run(drift: float, zero: float) -> Recording:
        run = make_run(95, 240.0)
        series = run["tractor_yaw_rate_radps"]
        wave = np.sin(2.0 * np.pi * series.time_s / 200.0 + 0.4)
        return run.with_channels({"tractor_yaw_rate_radps": Series(
            series.time_s, series.value + drift * wave + zero)})

    drifting, fixed = (sensor_gate([long_run(*one)]).findings
                       for one in ((6.0 * size, 0.0), (0.0, 6.0 * size)))
    assert [f.name for f in fixed] == ["yaw_rate_bias"]
    assert not drifting
