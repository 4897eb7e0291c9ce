from __future__ import annotations

import numpy as np
import pytest
import trial_faults as faults
from scipy.stats import chi2 as chi2_law
from trial_drive import make_run

from truck_blowout_sim.diagnosis.sensors.case import Case, Hypothesis, make_case
from truck_blowout_sim.diagnosis.sensors.judgement import admissible, family_p
from truck_blowout_sim.diagnosis.sensors.solve import noise_inflation, refine, solve
from truck_blowout_sim.diagnosis.sensors.system import assemble, normal_equations
from truck_blowout_sim.recordings import Recording, Series


def hypothesis(case: Case, name: str, instrument: str, *, everywhere: bool = True) -> Hypothesis:
    return next(
        h
        for h in case.hypotheses
        if (h.distortion.name, h.distortion.instrument, h.everywhere)
        == (name, instrument, everywhere)
    )


def test_the_closed_form_is_the_minimum_of_the_sum_of_squares() -> None:
    case = make_case([make_run(1, 8.0)], [], None)
    normal = normal_equations(assemble(case), {})
    fault = hypothesis(case, "yaw_rate_scale", "tractor yaw rate")
    found = solve(case, normal, [fault])
    prior = case.prior_precision
    at = prior.size
    for d in case.faults:
        if d == fault.distortion:
            break
        at += len(d.parameters)
    index = [*range(prior.size), at]
    gram, right = normal.gram[0][np.ix_(index, index)], normal.right[0][index]

    def cost(theta: np.ndarray) -> float:
        return float(
            normal.energy - 2 * right @ theta + theta @ gram @ theta
            + (theta[: prior.size] ** 2 * prior).sum() + theta[-1] ** 2
        )  # fmt: skip

    best = np.concatenate([found.usual, found.amounts[0]])
    assert cost(best) == pytest.approx(found.chi2, rel=1e-9)
    rng = np.random.default_rng(0)
    for _ in range(20):
        assert cost(best + 1e-3 * rng.standard_normal(best.size)) > found.chi2


def test_p_values_are_uniform_when_nothing_is_wrong() -> None:
    """Gains of all hypotheses over exact noisy runs follow their chi-square law, or stay below."""
    p_values, smallest = [], []
    for seed in range(8):
        runs = [make_run(300 + 2 * seed, 10.0), make_run(301 + 2 * seed, 10.0, steer=0.2)]
        case = make_case(runs, [], None)
        system = assemble(case)
        normal = normal_equations(system, noise_inflation(system))
        base = solve(case, normal, ())
        mine = []
        for h in case.hypotheses:
            gain = base.chi2 - solve(case, normal, [h]).chi2
            mine.append(float(chi2_law.sf(gain, len(h.distortion.parameters))))
        p_values += mine
        smallest.append(min(mine) * len(mine))
    p = np.array(p_values)
    # Priors on normal errors make the test conservative; it must not be liberal.
    assert np.mean(p < 0.05) < 0.08
    assert np.mean(p < 0.01) < 0.02
    assert np.mean(p < 0.5) > 0.15, "a test that never rejects would have no power either"
    assert min(smallest) > 1e-3


def test_refinement_reaches_a_large_delay_that_one_linear_step_misses() -> None:
    late = faults.delayed(["tractor_yaw_rate_radps"], 0.15)(make_run(5, 12.0))
    case = make_case([late], [], None)
    fault = hypothesis(case, "channel_delay", "tractor r")
    step = solve(case, normal_equations(assemble(case), {}), [fault])
    full = refine(case, [fault], {})
    assert full.amounts[0][0] == pytest.approx(0.15, abs=0.004)
    assert abs(step.amounts[0][0] - 0.15) > abs(full.amounts[0][0] - 0.15)
    assert full.chi2 < step.chi2


def test_baseline_is_not_touched_by_a_fault_that_is_not_there() -> None:
    sound, spoilt = make_run(7, 10.0), faults.offset("tractor_yaw_rate_radps", 0.004)(make_run(8))
    case = make_case([spoilt], [sound], None)
    normal = normal_equations(assemble(case), {})
    only_here = hypothesis(case, "yaw_rate_bias", "tractor yaw rate", everywhere=False)
    everywhere = hypothesis(case, "yaw_rate_bias", "tractor yaw rate", everywhere=True)
    here, both = solve(case, normal, [only_here]), solve(case, normal, [everywhere])
    assert here.amounts[0][0] == pytest.approx(0.004, abs=2e-4)
    assert here.chi2 < both.chi2 - 100.0


def test_misfit_of_an_identity_inflates_its_noise_and_no_other() -> None:
    run = make_run(9, 12.0)
    series = run["tractor_roll_rate_radps"]
    rough = series.value + 0.004 * np.sin(2 * np.pi * 2.3 * series.time_s) * np.sin(
        2 * np.pi * 0.31 * series.time_s
    )
    spoilt = run.with_channels({"tractor_roll_rate_radps": type(series)(series.time_s, rough)})
    inflation = noise_inflation(assemble(make_case([spoilt], [], None)))
    assert inflation["tractor roll rate"] > 1.5
    assert max(v for k, v in inflation.items() if k != "tractor roll rate") < 1.3


def test_family_p_counts_the_tests() -> None:
    assert family_p(30.0, 1, 100) == pytest.approx(100 * chi2_law.sf(30.0, 1))
    assert family_p(0.0, 1, 100) == 1.0
    assert family_p(-3.0, 2, 10) == 1.0


@pytest.mark.parametrize(
    ("forward", "left", "sensible"),
    [(0.6, 0.0, True), (-2.4, 1.05, True), (0.0, -2.8, False), (3.2, 0.0, False),
     (0.1, 0.1, False)],
)  # fmt: skip
def test_no_instrument_sits_beside_the_truck_or_where_it_is_said_to_sit(
    forward: float, left: float, sensible: bool
) -> None:
    case = make_case([make_run(1, 8.0)], [], None)
    arm = next(h for h in case.hypotheses if h.distortion.name == "lever_arm"
               and [n for n, _ in h.distortion.parameters] == ["forward", "left"])
    assert admissible(arm, (forward, left)) is sensible


@pytest.mark.parametrize("rate", [1e-3, 0.0, -1e-3])
def test_a_trailer_with_a_clock_of_its_own_is_a_normal_error(rate: float) -> None:
    """After 20 s it is 20 ms late, ten times what a channel is late by otherwise."""
    def slow(run: Recording) -> Recording:
        return run.with_channels({name: Series(series.time_s * (1.0 - rate), series.value)
                                  for name, series in run.channels.items()
                                  if name.startswith("trailer_")})

    case = make_case([slow(make_run(20 + k, 20.0)) for k in range(2)], [], None)
    found = solve(case, normal_equations(assemble(case), {}), ())
    names = [i.distortion.name for i in case.usual for _ in i.usual]
    k = names.index("clock")
    assert found.usual[k] == pytest.approx(rate, abs=4.0 * found.usual_sigma[k])
    assert found.usual_sigma[k] < 1e-4
