"""One round of the search: every hypothesis ranked, the promising ones refitted."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

import numpy as np

from truck_blowout_sim.diagnosis.case.study import Progress, Study
from truck_blowout_sim.diagnosis.effects import Effect, secondary_blowout
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.fit.attribute import Ranked, rank_steady
from truck_blowout_sim.diagnosis.fit.event_fit import fit_event
from truck_blowout_sim.diagnosis.fit.refit import chi2_of, models_at, refit
from truck_blowout_sim.diagnosis.fit.timed import refine_times, scan
from truck_blowout_sim.diagnosis.name.candidates import (
    failed_tires,
    steady_candidates,
    timed_effects,
    unwatched_tires,
)
from truck_blowout_sim.diagnosis.result.parts import Place

_TIMED_COST = 8.0  # evidence that choosing an instant in a run costs
_TIMED_SHARE = 0.15  # and the share that freedom of shape costs: steady causes come first
_WORTH_REFITTING = 0.25  # of the threshold
_HOLES = (0.1, 0.3, 1.0)  # of that of a commanded blowout: where to begin
_HALF = 0.5  # of what the best explains: less is no rival
_MUCH = 0.5  # of what is unusual: an event that explains it leaves no call for others
_LARGE = 3.0  # thresholds of mismatch, from which on a tire may have been lost unseen


def shortlist(study: Study, named: Sequence[Hypothesis], progress: Progress | None
              ) -> list[Ranked]:
    """All hypotheses not yet named, the promising ones refitted, best first."""
    taken = {h.key for h in named}
    chi2 = study.projector(named).chi2(study.residual())
    steady = [h for h in steady_candidates(study) if h.key not in taken]
    ranked = rank_steady(study, steady, named, progress)
    worth = _WORTH_REFITTING * study.settings.accept_delta
    promising = [one for one in ranked[:study.refits[0]] if one.promise > worth]
    done = [*_refitted(study, promising, chi2, named, progress),
            *ranked[len(promising):]]
    best = max((r.delta for r in done if r.refitted), default=0.0)
    done += _events(study, named, chi2, max(worth, _HALF * best), ranked, progress)
    best_of: dict[tuple[str, str], Ranked] = {}
    for one in sorted(done, key=lambda r: (-r.delta, r.hypothesis.key)):
        if one.hypothesis.key not in taken:
            best_of.setdefault(one.hypothesis.key, one)
    return list(best_of.values())


def _refitted(study: Study, chosen: Sequence[Ranked], chi2: float, named: Sequence[Hypothesis],
              progress: Progress | None) -> list[Ranked]:
    """Each at its best amount, side by side; the same numbers as one after another."""
    study.projector(named)  # made once, before all ask for it
    alone = [replace(study, workers=1, simulations=0) for _ in chosen]
    done: list[Ranked] = []
    with ThreadPoolExecutor(study.workers) as pool:
        for one in pool.map(lambda k: refit(alone[k], chosen[k], chi2, named), range(len(chosen))):
            done.append(one)
            if progress:
                progress("refitting", len(done) / len(chosen))
    study.simulations += sum(one.simulations for one in alone)
    return done


def _events(study: Study, named: Sequence[Hypothesis], chi2: float, worth: float,
            steady: Sequence[Ranked], progress: Progress | None) -> list[Ranked]:
    """Tires that lost pressure by themselves, and everything scanned over time."""
    excess = chi2 - study.settings.expected_level * study.columns.shape[0]
    found = [_failed(study, named, chi2, tire, times)
             for tire, times in failed_tires(study, study.train).items()]
    projector, tried = study.projector(named), _event_places(study, named, steady)
    scanned = []
    for k, (effect, place) in enumerate(tried):
        scanned.append(scan(study, projector, effect, place, named))
        if progress:
            progress("events", (k + 1) / len(tried))
    scanned.sort(key=lambda r: -r.delta)
    large = _large(study, [*steady, *scanned])
    keys: set[tuple[str, str]] = set()
    for one in scanned:
        cost = _TIMED_COST * len(one.hypothesis.times) + _TIMED_SHARE * one.delta
        # what acts only near a limit shows little to a linear scan: looked at where much is open
        curved = bool(one.hypothesis.effect.amount.grid) and large and (
            max((r.delta for r in found), default=0.0) < _MUCH * excess)
        among = one.hypothesis.key in keys or len(keys) < study.refits[1]
        worth = max(worth, _HALF * max((r.delta for r in found), default=0.0))
        if one.hypothesis.times and (curved or (among and one.delta - cost > worth)):
            keys.add(one.hypothesis.key)
            one = refine_times(study, one, chi2, named)
            one = fit_event(study, refit(study, one, chi2, named), chi2, named)
            cost = _TIMED_COST * len(one.hypothesis.times) + _TIMED_SHARE * max(one.delta, 0.0)
        found.append(replace(one, delta=one.delta - cost, evidence=one.evidence - cost))
    return found


def _large(study: Study, ranked: Sequence[Ranked]) -> bool:
    """Whether the mismatch is large enough to look where it costs more."""
    return max((max(r.promise, r.delta) for r in ranked), default=0.0) > (
        _LARGE * study.settings.accept_delta)


def _event_places(study: Study, named: Sequence[Hypothesis], steady: Sequence[Ranked]
                  ) -> list[tuple[Effect, Place]]:
    """Where each event is looked for: another form only where the steady one explains something."""
    settings, taken = study.settings, {h.key for h in named}
    idle = {r.hypothesis.effect.name for r in steady} - {
        r.hypothesis.effect.name for r in steady
        if r.promise > _WORTH_REFITTING * settings.accept_delta}
    tried: list[tuple[Effect, Place]] = []
    for effect in timed_effects(study):
        places = effect.places(study.packed.vehicle)
        if effect.name == secondary_blowout.EFFECT.name:
            places = unwatched_tires(study) if _large(study, steady) else ()
        elif effect.variant and effect.name in idle:
            continue
        tried += [(effect, p) for p in places if (effect.name, str(p)) not in taken]
    return tried


def _failed(study: Study, named: Sequence[Hypothesis], chi2: float, tire: str,
            times: Mapping[str, float]) -> Ranked:
    """A tire seen to lose its pressure: the hypothesis at those instants, its hole refitted.

    No motion of the truck tells the instant as well as the gauge does.
    """
    effect = secondary_blowout.EFFECT
    place = next(p for p in effect.places(study.packed.vehicle) if p.tire == tire)
    spans = {run: (t, np.inf) for run, t in times.items()}
    starts = [Hypothesis(effect, place, hole, spans) for hole in _HOLES]
    projector = study.projector([*named, starts[0]])
    sums = [chi2_of(study, projector, models) for models in models_at(study, starts, named)]
    return refit(study, Ranked(starts[int(np.argmin(sums))], 0.0, 1.0), chi2, named)
