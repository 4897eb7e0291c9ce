"""Profile likelihood and block jackknife against the closed form of a Gaussian model."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from truck_blowout_sim.diagnosis.answer.words import open_ends
from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.effects import LIBRARY
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.fit.models import models_at
from truck_blowout_sim.diagnosis.fit.ranked import Ranked
from truck_blowout_sim.diagnosis.fit.refit import refit
from truck_blowout_sim.diagnosis.prove.profile import (
    NINETY,
    Arms,
    _crossing,
    arms_of,
    block_sigma,
)
from truck_blowout_sim.vehicle import Packed

Studies = Callable[..., Study]


def found_in(study: Study, truck: Packed, name: str, start: float, at: int = 0) -> Ranked:
    """The effect, refitted in the study."""
    effect = next(e for e in LIBRARY if e.name == name and not e.timed)
    place = effect.places(truck.vehicle)[at]
    chi2 = study.projector().chi2(study.residual())
    return refit(study, Ranked(Hypothesis(effect, place, start), 0.0, abs(start)), chi2)


@pytest.fixture(scope="module")
def dragging(study_of: Studies, truck: Packed) -> tuple[Study, Ranked]:
    """A truck with more drag, and what the refit makes of it."""
    study = study_of({"unit.trailer.drag_area_extra_m2": 5.0}, baseline=True)
    return study, found_in(study, truck, "aerodynamic_drag", 3.0, at=1)


def test_where_the_model_is_linear_the_profile_is_the_standard_error(
    dragging: tuple[Study, Ranked]
) -> None:
    study, found = dragging
    arms = arms_of(study, found)
    assert arms.below == pytest.approx(NINETY * found.sigma, rel=0.1)
    assert arms.above == pytest.approx(NINETY * found.sigma, rel=0.1)


def test_a_side_that_ends_at_what_is_physical_is_open_and_said_so(
    dragging: tuple[Study, Ranked]
) -> None:
    study, found = dragging
    h = found.hypothesis
    amount = replace(h.effect.amount, high=h.amount + 0.5 * found.sigma)
    near = replace(found, hypothesis=replace(h, effect=replace(h.effect, amount=amount)))
    arms = arms_of(study, near)
    assert np.isinf(arms.above)
    assert np.isfinite(arms.below)
    assert arms.wider(0.1)[1] == np.inf
    assert open_ends((1.0, np.inf)) == " These recordings set no upper bound."
    assert open_ends((-np.inf, np.inf)) == " These recordings set no lower and no upper bound."
    assert open_ends((1.0, 2.0)) == ""


def test_blocks_left_out_show_the_noise_and_more_where_misfit_lasts(
    dragging: tuple[Study, Ranked]
) -> None:
    """White residuals give what white noise does; the same, held for half a second, far more."""
    study, found = dragging
    plain, lasting = [], []
    for seed in range(12):
        rng = np.random.default_rng(seed)
        plain.append(block_sigma(with_noise(study, found, rng, 1), found, block_s=0.5))
        lasting.append(block_sigma(with_noise(study, found, rng, 5), found, block_s=0.5))
    assert np.mean(plain) == pytest.approx(scatter_of(study, found), rel=0.15)
    assert np.mean(lasting) > 1.8 * np.mean(plain)


def scatter_of(study: Study, found: Ranked) -> float:
    """What unit noise on the records alone does to the amount: |C^-1 d| over d' C^-1 d."""
    h, step = found.hypothesis, found.hypothesis.effect.amount.step
    here, ahead = models_at(study, [h, h.at(h.amount + step)], ())
    column = study.stack({i: study.runs[i].change(ahead[i], here[i]) for i in study.train}) / step
    clean = study.projector([h]).remove(column)
    return float(np.linalg.norm(clean) / (column @ clean))


def with_noise(study: Study, found: Ranked, rng: np.random.Generator, held: int) -> Study:
    """The study, its records the found truck's plus unit noise, each draw held for some bins."""
    models = {**dict(enumerate(study.models)), **models_at(study, [found.hypothesis], ())[0]}
    runs = []
    for i, run in enumerate(study.runs):
        n, m = run.measured.shape
        draws = np.repeat(rng.standard_normal((n // held + 1, m)), held, axis=0)[:n]
        runs.append(replace(run, measured=models[i] + run.sigma * draws))
    return replace(study, runs=tuple(runs))


def test_the_widest_of_what_is_known_is_told() -> None:
    arms = Arms(below=0.5, above=0.1, block_sigma=0.2)
    below, above = arms.wider(0.0)
    assert (below, above) == pytest.approx((0.5, NINETY * 0.2))
    assert arms.wider(0.3)[0] == pytest.approx(np.hypot(0.5, NINETY * 0.3))


def test_an_amount_at_its_bound_is_open_on_that_side() -> None:
    """A brake that is dead: the other end stays what it is."""
    arms = Arms(*(abs(_crossing(lambda a: (a / 0.1)**2, 0.0, bound, 0.1)) for bound in (0.0, 1.0)),
                block_sigma=0.0)
    assert arms.below == np.inf
    assert arms.above == pytest.approx(0.1 * NINETY, rel=0.02)
