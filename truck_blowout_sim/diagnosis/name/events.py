"""The events of a round: where each is looked for, when it began, whether it stands out."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace

import numpy as np

from truck_blowout_sim.diagnosis.case.study import Progress, Study
from truck_blowout_sim.diagnosis.effects import Effect, secondary_blowout
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.fit.begun import begun_everywhere
from truck_blowout_sim.diagnosis.fit.beside import Beside
from truck_blowout_sim.diagnosis.fit.event_fit import fit_event
from truck_blowout_sim.diagnosis.fit.models import models_at
from truck_blowout_sim.diagnosis.fit.ranked import Ranked
from truck_blowout_sim.diagnosis.fit.refit import chi2_of, refit
from truck_blowout_sim.diagnosis.fit.scatter import Chance
from truck_blowout_sim.diagnosis.fit.support import supported
from truck_blowout_sim.diagnosis.fit.timed import (
    at_best_instants,
    refine_times,
    scan,
    simulated_starts,
)
from truck_blowout_sim.diagnosis.fit.windows import log_sum
from truck_blowout_sim.diagnosis.locate.sinking import sinking_hubs
from truck_blowout_sim.diagnosis.name.candidates import (
    failed_tires,
    timed_effects,
    unwatched_tires,
)
from truck_blowout_sim.diagnosis.name.judging import ODDS, at_bound
from truck_blowout_sim.diagnosis.result.parts import Place

_TIMED_COST = 8.0  # evidence that choosing an instant in a run costs
_TURNS = 4  # at most: instants, then amount and law
_TIMED_SHARE = 0.15  # and the share that freedom of shape costs: steady causes come first
_HOLES = (0.1, 0.3, 1.0)  # of that of a commanded blowout: where to begin
_HALF = 0.5  # of what the best explains: less is no rival
_SEEN_TWICE = 3.84  # support of an event that unseen runs show, too: chance reaches it in 5 %
_LARGE = 8.0  # times what is asked: a mismatch from which on a tire may have been lost unseen


def event_places(study: Study, named: Sequence[Hypothesis], steady: Sequence[Ranked],
                 chance: Chance) -> list[tuple[Effect, Place]]:
    """Where to look: for another form of an event where one explains something, or is supported.

    A grade that begins on the way contradicts a steady one in what was driven before it.
    For a lost tire where much is open, or at a hub that sinks.
    """
    lost, places = secondary_blowout.EFFECT, _possible(study, named)
    hubs = {place.hub for effect, place in places if effect.name == lost.name and place.hub}
    if not _large(steady, chance):
        hubs &= sinking_hubs(study, named, chance.asked, hubs)

    def worth(effect: Effect, place: Place) -> bool:
        if effect.name == lost.name:
            return place.hub in hubs
        own = [max(r.promise, r.support) for r in steady if r.hypothesis.effect.name == effect.name]
        return not effect.variant or not own or max(own) > chance.asked

    return [(effect, place) for effect, place in places if worth(effect, place)]


def _possible(study: Study, named: Sequence[Hypothesis]) -> list[tuple[Effect, Place]]:
    """Where each event could be looked for."""
    taken = {h.key for h in named}
    tried: list[tuple[Effect, Place]] = []
    for effect in timed_effects(study):
        places = (unwatched_tires(study) if effect.name == secondary_blowout.EFFECT.name
                  else effect.places(study.packed.vehicle))
        tried += [(effect, p) for p in places if (effect.name, str(p)) not in taken]
    return tried


def rank_events(study: Study, beside: Beside, chi2: float, chance: Chance,
                steady: Sequence[Ranked], places: Sequence[tuple[Effect, Place]],
                progress: Progress | None) -> list[Ranked]:
    """Tires that lost pressure by themselves, and everything scanned over time."""
    failed = [supported(study, _failed(study, beside.named, chi2, tire, times), beside, chance)
              for tire, times in failed_tires(study, study.train).items()]
    scanned = sorted(_scanned(study, beside, places, chance.asked, progress),
                     key=lambda r: (r.support < chance.asked, -r.delta))
    found = _fitted(study, scanned, failed, beside, chi2, chance, steady)
    rivals = [r for r in (*steady, *found) if r.refitted and not at_bound(r.hypothesis)]
    least = study.settings.law_leaves * max((r.delta for r in rivals), default=0.0)
    stands = any(r.support >= chance.asked for r in rivals if not r.hypothesis.effect.timed)
    # what acts all the time shows in unseen runs, too, and a long event imitates it
    return _confirmed(study, found, beside, chance, least, trusted=not stands)


def _fitted(study: Study, scanned: Sequence[Ranked], failed: Sequence[Ranked], beside: Beside,
            chi2: float, chance: Chance, steady: Sequence[Ranked]) -> list[Ranked]:
    """All events, those that are worth it fitted, what their free instants cost paid."""
    large = _large([*steady, *scanned], chance)
    worth = max(chance.asked, _HALF * max((r.delta for r in steady if r.refitted), default=0.0))
    found, keys = list(failed), set[tuple[str, str]]()
    for one in scanned:
        starts = [one] if _promising(study, one, found, keys, worth, chance) else []
        # what acts only near a limit shows little to a linear scan: looked at where much is open
        if one.hypothesis.effect.amount.grid and large and _much_open(study, found, chi2):
            starts = simulated_starts(study, one, chi2, beside.named)[:study.refits[1]]
        if any(each.hypothesis.times for each in starts):
            keys.add(one.hypothesis.key)
            one = _best_fitted(study, one, starts, beside, chi2, chance)
        cost = _cost(one)
        found.append(replace(one, delta=one.delta - cost, evidence=one.evidence - cost))
    return found


def _cost(one: Ranked) -> float:
    """What the free instants of an event cost, and its free shape."""
    return _TIMED_COST * len(one.hypothesis.times) + _TIMED_SHARE * max(one.delta, 0.0)


def _promising(study: Study, one: Ranked, found: Sequence[Ranked],
               keys: Collection[tuple[str, str]], worth: float, chance: Chance) -> bool:
    """Whether a scanned event is worth a fit beside what was found, ``keys`` of it fitted."""
    most, left = max((r.delta for r in found), default=0.0), one.delta - _cost(one)
    among = one.hypothesis.key in keys or len(keys) < study.refits[1] or left > most
    return among and (left > max(worth, _HALF * most) or one.support > chance.asked)


def _much_open(study: Study, found: Sequence[Ranked], chi2: float) -> bool:
    """Whether all that was found leaves more than an inexact form of its law may."""
    excess = chi2 - study.level * study.columns.shape[0]
    explained = max((r.delta for r in found if not at_bound(r.hypothesis)), default=0.0)
    return explained < (1.0 - study.settings.law_leaves) * excess


def _best_fitted(study: Study, scanned: Ranked, starts: Sequence[Ranked], beside: Beside,
                 chi2: float, chance: Chance) -> Ranked:
    """The event from the start that explains most; what adds up keeps its support of the scan."""
    best = max((fitted_event(study, each, chi2, beside.named) for each in starts),
               key=lambda r: r.delta)
    if best.hypothesis.effect.adds_up:
        return replace(best, support=scanned.support, unseen=scanned.unseen)
    return supported(study, best, beside, chance)


def fitted_event(study: Study, one: Ranked, chi2: float, named: Sequence[Hypothesis] = ()
                 ) -> Ranked:
    """Instants, amount and law of an event, by turns until they explain no more.

    At a stronger amount, and another law, other instants are best, farther than a descent goes. For
    an event that is far from linear, the whole grid is searched again, but not in a quick answer.
    """
    best, again = None, one.hypothesis.effect.adds_up or study.refits[1] > 1
    for _ in range(_TURNS):
        one = refit(study, refine_times(study, one, chi2, named), chi2, named)
        one = fit_event(study, one, chi2, named)
        gained = one.delta - best.delta if best else np.inf
        best = one if gained > 0.0 else best
        if gained < _TIMED_COST or not again:
            break
        if not one.hypothesis.effect.adds_up:
            moved, = at_best_instants(study, [one.hypothesis], named)
            one = replace(one, hypothesis=moved)
    return best or one


def _failed(study: Study, named: Sequence[Hypothesis], chi2: float, tire: str,
            times: Mapping[str, float]) -> Ranked:
    """A tire seen to lose its pressure: the hypothesis at those instants, its hole refitted.

    Its instants begin where the gauge has them, and are fitted: a gauge may read once a second.
    """
    effect = secondary_blowout.EFFECT
    place = next(p for p in effect.places(study.packed.vehicle) if p.tire == tire)
    spans = {run: (t, np.inf) for run, t in times.items()}
    starts = [Hypothesis(effect, place, hole, spans) for hole in _HOLES]
    projector = study.projector([*named, starts[0]])
    sums = [chi2_of(study, projector, models) for models in models_at(study, starts, named)]
    found = refit(study, Ranked(starts[int(np.argmin(sums))], 0.0, 1.0), chi2, named)
    return fit_event(study, found, chi2, named)


def _scanned(study: Study, beside: Beside, places: Sequence[tuple[Effect, Place]],
             asked: float, progress: Progress | None) -> list[Ranked]:
    """Each event at its best instants; another form of it only where the plain one is supported.

    Or explains much, however it scatters: a block of the load, not all of it, may have moved.

    Forms of one event, as the places where a wind may take hold, share their support: its mean
    odds. Which of them it is, the sum of squares says.
    """
    projector = study.projector(beside.named)
    forms: dict[tuple[str, str], list[Ranked]] = {}
    for variant in sorted({effect.variant for effect, _ in places}):
        tried = [(effect, place) for effect, place in places if effect.variant == variant
                 and _worth_another(forms.get((effect.name, str(place)), ()), effect, asked)]
        begun = begun_everywhere(study, [Hypothesis(effect, place, effect.amount.step)
                                         for effect, place in tried], beside.named, progress)
        for (effect, place), means in zip(tried, begun, strict=True):
            forms.setdefault((effect.name, str(place)), []).append(
                scan(study, projector, effect, place, means, beside))
    for key, found in forms.items():
        if found[0].hypothesis.effect.adds_up:
            mean = _mean_odds([r.support for r in found])
            fitted = _mean_odds([r.support - r.unseen for r in found])
            # unseen runs confirm what the others show, or refute it; against them they show none
            mean = mean if fitted > -ODDS else min(mean, fitted)
            forms[key] = [replace(r, support=mean, unseen=mean - fitted) for r in found]
    return [one for found in forms.values() for one in found]


def _worth_another(forms: Sequence[Ranked], effect: Effect, asked: float) -> bool:
    """Whether to look for a further form of an event, given what was found of its forms so far."""
    return not (forms and effect.adds_up) or (
        forms[0].support > 0.0 or forms[0].delta > _LARGE * asked)


def _confirmed(study: Study, found: Sequence[Ranked], beside: Beside, chance: Chance,
               least: float, trusted: bool) -> list[Ranked]:
    """Events that stand out of their own force, less what scatters so much for all hypotheses.

    How far runs scatter at all, the other hypotheses know. The event was chosen before, so it is
    asked as a single question. If unseen runs show the same event and are ``trusted``, less is
    asked, though not nothing: a model's form errs in all runs alike. No odds are better than what
    is explained, free instants paid. What explains less than ``least`` is no event: its force is
    not what moves the vehicle, and linear responses say little of what does.
    """
    checked = list(found)
    strong = [k for k, one in enumerate(found) if one.refitted and one.hypothesis.effect.adds_up
              and one.support >= chance.asked]
    for key in {found[k].hypothesis.key for k in strong}:
        forms = [k for k in strong if found[k].hypothesis.key == key]
        again = _mean_odds([supported(study, found[k], beside, chance).support for k in forms])
        asked = chance.alone.asked
        if trusted and found[forms[0]].unseen >= asked:
            asked = min(_SEEN_TWICE, asked)
        for k in forms:
            most = found[k].support if again >= asked else again
            most = most if found[k].delta >= least else 0.0
            checked[k] = replace(found[k], support=min(found[k].support, most, found[k].delta))
    return checked


def _mean_odds(supports: Sequence[float]) -> float:
    """Support of a hypothesis that has several forms."""
    return float(2.0 * log_sum(0.5 * np.asarray(supports)) - 2.0 * np.log(len(supports)))


def _large(ranked: Sequence[Ranked], chance: Chance) -> bool:
    """Whether the mismatch is large enough to look where it costs more."""
    return max((max(r.promise, r.delta) for r in ranked), default=0.0) > _LARGE * chance.asked
