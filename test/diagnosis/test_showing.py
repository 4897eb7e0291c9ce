"""Amounts below what the answer says would show are not named, amounts above are."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.effects import axle_misalignment
from truck_blowout_sim.diagnosis.fit.scatter import Chance, Scatter
from truck_blowout_sim.diagnosis.fit.shown import SCATTERS, Question, Shown
from truck_blowout_sim.diagnosis.fit.width_error import degrees_of, most_supported
from truck_blowout_sim.diagnosis.name import candidates
from truck_blowout_sim.diagnosis.name.search import search
from truck_blowout_sim.diagnosis.prove.showing import smallest, would_show

NO_SCATTER = Scatter(np.where(SCATTERS == 0.0, 1.0, 0.0) / (SCATTERS == 0.0).sum())


def shown(information: float, runs: int = 2) -> Shown:
    """Training runs that each show as much of an amount."""
    return Shown(information * np.eye(runs), np.zeros(runs), np.ones(runs), np.ones((runs, runs)),
                 np.eye(runs))


def asked(bounds: tuple[float, float]) -> Question:
    """Only its bounds are used."""
    question = object.__new__(Question)
    object.__setattr__(question, "bounds", bounds)
    return question


@pytest.mark.parametrize("information", [1.0, 50.0])
def test_without_scatter_it_is_the_amount_whose_square_is_asked(information: float) -> None:
    """Support is A^2 (d_1'd_1 + d_2'd_2) then, but no more than widths that are estimates allow."""
    chance, degrees = Chance(NO_SCATTER, 30.0, 0.01), degrees_of(2)
    below, above = smallest(shown(information), chance, asked((-100.0, 100.0)), degrees)
    assert above is not None
    assert below == pytest.approx(-above)
    fall = above**2 * 2.0 * information
    assert min(fall, most_supported(fall, degrees)) == pytest.approx(chance.asked, rel=0.06)


def test_where_nothing_would_show_up_to_the_end_nothing_is_said() -> None:
    chance = Chance(NO_SCATTER, 30.0, 0.01)
    assert smallest(shown(1.0), chance, asked((0.0, 0.5)), degrees_of(2)) == (None, None)


def test_the_more_runs_scatter_the_more_is_needed() -> None:
    much = Scatter(np.where(SCATTERS == 8.0, 1.0, 0.0) / (SCATTERS == 8.0).sum())
    ends = [smallest(shown(50.0, 4), Chance(one, 30.0, 0.01), asked((0.0, 100.0)), degrees_of(4))[1]
            for one in (NO_SCATTER, much)]
    assert ends[0] is not None
    assert ends[1] is not None
    assert ends[1] > 2.0 * ends[0]


def test_twice_the_amount_is_named_and_less_than_half_of_it_is_not(
    study_of: Callable[..., Study], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(candidates, "LIBRARY", (axle_misalignment.EFFECT,))
    study = study_of(baseline=True, holdout={})
    (one,) = would_show(study, search(study, most=1).chance)
    assert one.name == "axle_misalignment"
    assert one.below is not None
    assert one.above is not None
    for factor, named in ((2.0, ["axle_misalignment"]), (0.4, [])):
        turned = {f"axle.{one.where.axle}.misalignment_rad": factor * one.above}
        found = search(study_of(turned, baseline=True, holdout=turned), most=1)
        assert [r.hypothesis.effect.name for r in found.named] == named


def test_without_a_search_nothing_is_said(study_of: Callable[..., Study]) -> None:
    assert would_show(study_of(), None) == ()
