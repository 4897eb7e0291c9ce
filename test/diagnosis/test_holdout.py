"""Events in unseen runs: located with what the calibration leaves open."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from truck_blowout_sim.diagnosis.algebra.linear import Projector
from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.effects import LIBRARY
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.fit.models import with_effects
from truck_blowout_sim.diagnosis.name.judging import predicts_better
from truck_blowout_sim.diagnosis.prove.holdout import Prediction, _Carried, _place
from truck_blowout_sim.vehicle import Packed

Studies = Callable[..., Study]
BEGINS_S, LASTS_S, SPEED_MPS = 3.0, 2.0, 12.0


@pytest.fixture
def gust(truck: Packed) -> Hypothesis:
    effect = next(e for e in LIBRARY if e.name == "crosswind" and e.timed)
    return Hypothesis(effect, effect.places(truck.vehicle)[0], SPEED_MPS,
                      {"run 1": (1.0, 1.0 + LASTS_S)})


def blown_from(truck: Packed, gust: Hypothesis, at_s: float) -> dict[str, float]:
    timed = gust.effect.timed
    assert timed is not None
    return {**gust.effect.values(truck, gust.place, SPEED_MPS),
            **timed(truck, gust.place, at_s, at_s + LASTS_S)}


@pytest.mark.parametrize("known", [True, False])
def test_an_event_is_placed_where_the_run_is_then_predicted_best(
    study_of: Studies, truck: Packed, gust: Hypothesis, known: bool
) -> None:
    study = study_of(holdout=blown_from(truck, gust, BEGINS_S))
    (run,), (columns,) = study.holdout, study.holdout_columns
    # what is open may take most of the gust as its own
    spread = columns * (0.0 if known else 3.0)
    carried = _Carried(np.zeros(columns.shape[0]), Projector.of(spread))
    placed = _place(study, run, carried, (), gust)
    assert placed is not None
    name = run.recording.name
    assert placed.times[name][0] == pytest.approx(BEGINS_S, abs=0.3)

    def left(at_s: float) -> float:
        one = Hypothesis(gust.effect, gust.place, SPEED_MPS, {name: (at_s, at_s + LASTS_S)})
        (model,) = study.simulate([(run, with_effects(study.packed, [one], name))])
        return carried.left(run, model)
    assert left(placed.times[name][0]) <= min(left(t) for t in np.arange(0.9, 6.0, 0.5)) + 1e-9


def test_an_event_that_a_run_does_not_show_is_left_out(
    study_of: Studies, gust: Hypothesis
) -> None:
    study = study_of(holdout={})
    (run,), (columns,) = study.holdout, study.holdout_columns
    carried = _Carried(np.zeros(columns.shape[0]), Projector.of(0.0 * columns))
    assert _place(study, run, carried, (), gust) is None


def test_a_badly_predicted_run_says_less_and_a_calm_one_no_more_than_its_squares(
    study_of: Studies) -> None:
    run = study_of(holdout={}).holdout[0]
    seen = int(np.isfinite(run.measured).sum())

    def better(before: float, after: float) -> float:
        first, then = (Prediction(run, share * seen, run.residual(run.measured), ())
                       for share in (before, after))
        return predicts_better([first], [then])

    assert better(0.6, 0.5) == pytest.approx(0.1 * seen)
    assert better(8.0, 4.0) == pytest.approx(np.log(2.0) * seen)
    assert better(2.0, 0.5) == pytest.approx(better(2.0, 1.0) + better(1.0, 0.5))
    assert better(0.5, 0.6) == pytest.approx(-better(0.6, 0.5))
