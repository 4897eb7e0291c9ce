"""An event at its own instants, against a force without rest."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from scipy.special import logsumexp

from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.effects import LIBRARY, Effect
from truck_blowout_sim.diagnosis.fit import shaped
from truck_blowout_sim.diagnosis.fit.attribute import Ranked
from truck_blowout_sim.diagnosis.fit.event_fit import fit_event
from truck_blowout_sim.diagnosis.fit.models import models_at
from truck_blowout_sim.diagnosis.fit.refit import refit
from truck_blowout_sim.diagnosis.fit.seconds import Seconds
from truck_blowout_sim.diagnosis.fit.shaped import shaped_support
from truck_blowout_sim.diagnosis.fit.timed import refine_times, scan
from truck_blowout_sim.vehicle import Packed

Studies = Callable[..., Study]
WIND = next(e for e in LIBRARY if e.name == "crosswind" and not e.variant)


def blown(truck: Packed, wind_mps: float, start_s: float, end_s: float) -> dict[str, float]:
    place = next(p for p in WIND.places(truck.vehicle) if p.body == "trailer")
    assert WIND.timed is not None
    return {**WIND.values(truck, place, wind_mps), **WIND.timed(truck, place, start_s, end_s)}


def fitted(study: Study, effect: Effect = WIND) -> tuple[Ranked, Seconds]:
    """The event on the trailer at the best of all its numbers, with what whole seconds say."""
    place = next(p for p in effect.places(study.packed.vehicle) if p.body == "trailer")
    rough, seconds = scan(study, study.projector(), effect, place)
    assert seconds is not None
    chi2 = study.projector().chi2(study.residual())
    fine = fit_event(study, refit(study, refine_times(study, rough, chi2), chi2), chi2)
    return replace(fine, support=rough.support), seconds


def test_a_gust_between_whole_seconds_is_supported(study_of: Studies, truck: Packed) -> None:
    study = study_of(blown(truck, 14.0, 2.42, 3.81), baseline=True)
    event, seconds = fitted(study)
    assert shaped_support(study, event, seconds) > max(event.support, 12.0)


@pytest.mark.parametrize("changes", [{}, {"unit.trailer.mass_kg": 1.02}])
def test_where_nothing_blows_nothing_is_supported(
        study_of: Studies, truck: Packed, changes: dict[str, float]) -> None:
    study = study_of({name: by * truck[name] for name, by in changes.items()}, baseline=True)
    event, seconds = fitted(study)
    assert shaped_support(study, event, seconds) < 8.0


def test_two_looks_are_averaged(study_of: Studies, truck: Packed) -> None:
    """What whole seconds say counts half, so that the better of two looks is no better chance."""
    study = study_of(blown(truck, 14.0, 2.42, 3.81), baseline=True)
    event, seconds = fitted(study)
    alone = shaped_support(study, replace(event, support=-1e9), seconds)
    both = shaped_support(study, replace(event, support=alone + 2.0 * np.log(2.0)), seconds)
    assert both == pytest.approx(alone + 2.0 * np.log(2.0))


def test_laplace_agrees_with_a_sum_over_amounts(study_of: Studies, truck: Packed,
                                                monkeypatch: pytest.MonkeyPatch) -> None:
    """With instants that are known, the integral over the amount is a sum that can be made."""
    study = study_of(blown(truck, 14.0, 2.42, 3.81), baseline=True)
    event, seconds = fitted(study)
    monkeypatch.setattr(shaped, "event_columns", lambda study, h, named: (
        every(study, h, named)[0][:, :1], np.ones(1)))
    monkeypatch.setattr(shaped, "_log_prior", lambda study, h, wide: float(
        -0.5 * (h.amount / wide)**2 - np.log(wide * np.sqrt(2.0 * np.pi))))
    found = shaped_support(study, replace(event, support=-1e9), seconds) / 2.0
    forms = sum(e.name == "crosswind" for e in LIBRARY)
    odds = found + np.log(2.0) + np.log(forms) + seconds.windows.without()
    assert odds == pytest.approx(summed(study, event, seconds), abs=0.5)


every = shaped.event_columns


def summed(study: Study, event: Ranked, seconds: Seconds) -> float:
    """Log of the likelihood summed over amounts, each simulated, all processes alike."""
    h, wide, projector = event.hypothesis, seconds.windows.wide, seconds.projector
    amounts = h.amount + np.linspace(-6.0, 6.0, 25) * event.sigma
    null = projector.chi2(study.residual())
    total = []
    for amount, models in zip(amounts.tolist(), models_at(
            study, [h.at(a) for a in amounts.tolist()], ()), strict=True):
        left = study.residual(models)
        seen, fall = seconds.seen_of(study, left), null - projector.chi2(left)
        prior = -0.5 * (amount / wide)**2 - np.log(wide * np.sqrt(2.0 * np.pi))
        total += [0.5 * fall + prior + float(logsumexp(process.likelihoods(seen)))
                  for process in seconds.windows.processes()]
    return float(logsumexp(total) + np.log(amounts[1] - amounts[0]))
