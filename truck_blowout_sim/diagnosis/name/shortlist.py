"""One round of the search: every hypothesis ranked, the promising ones refitted."""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace

from truck_blowout_sim.diagnosis.case.study import Progress, Study
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.fit.beside import Beside
from truck_blowout_sim.diagnosis.fit.ranked import Ranked
from truck_blowout_sim.diagnosis.fit.refit import refit
from truck_blowout_sim.diagnosis.fit.scatter import Chance
from truck_blowout_sim.diagnosis.fit.steady import rank_steady
from truck_blowout_sim.diagnosis.fit.support import supported
from truck_blowout_sim.diagnosis.name.candidates import steady_candidates
from truck_blowout_sim.diagnosis.name.events import event_places, rank_events
from truck_blowout_sim.diagnosis.name.judging import ALIAS_SHARE


@dataclass(frozen=True, eq=False)
class Round:
    """One round: every hypothesis, best first, and what chance reaches among so many.

    ``beside``: what was in force.
    """

    ranked: tuple[Ranked, ...]
    chance: Chance
    beside: Beside


def shortlist(study: Study, named: Sequence[Hypothesis], progress: Progress | None,
              further: float = 0.0, placed: Sequence[Sequence[Hypothesis]] = ()) -> Round:
    """All hypotheses not yet named, the promising ones refitted, best first.

    Args:
        study: its models have ``named`` in force.
        named: hypotheses; ``placed``: the same in each unseen run, with events at their instants.
        progress: is told how far the round has come.
        further: support asked beyond chance.
    """
    taken = {h.key for h in named}
    chi2 = study.projector(named).chi2(study.residual())
    steady = [h for h in steady_candidates(study) if h.key not in taken]
    ranking = rank_steady(study, steady, named, progress)
    ranked, beside = ranking.ranked, Beside.of(study, named, study.models, placed)
    chance = Chance(ranking.scatter, ranking.independent, study.alarms_by_name, ranking.questions,
                    further)
    places = event_places(study, named, ranked, chance)
    events = {(effect.name, str(place)) for effect, place in places}
    chance = replace(chance, independent=ranking.independent + len(events))
    promising = _promising(ranked, chance, study.refits[0])
    forms = {one.hypothesis.form for one in promising}
    done = [*_refitted(study, promising, chi2, beside, chance, progress),
            *(one for one in ranked if one.hypothesis.form not in forms)]
    done += rank_events(study, beside, chi2, chance, done, places, progress)
    best = best_forms([one for one in done if one.hypothesis.key not in taken], chance.asked)
    return Round(tuple(best), chance, beside)


def best_forms(ranked: Sequence[Ranked], asked: float) -> list[Ranked]:
    """Of two forms of one effect the one that explains more, of those that are supported if any.

    A grade that begins at a place explains more than a steady one, for its instants are free; that
    it is not supported so far says nothing against the steady one.
    """
    best: dict[tuple[str, str], Ranked] = {}
    for one in sorted(ranked, key=lambda r: (not r.refitted or r.support < asked, -r.delta)):
        best.setdefault(one.hypothesis.key, one)
    return sorted(best.values(), key=lambda r: (-r.delta, r.hypothesis.key))


def _promising(ranked: Sequence[Ranked], chance: Chance, most: int) -> list[Ranked]:
    """What to fit anew: by turns the best by what it explains and by how well it is supported.

    Also the best place of every other effect that explains enough to be an alias: places of one
    effect that are alike must not hide it. Of an effect at a place every law that explains
    something is fitted.
    """
    worth = [one for one in ranked if one.promise > chance.asked]
    chosen: dict[tuple[str, str], list[Ranked]] = {}
    for pair in zip(worth, sorted(worth, key=lambda r: -r.support), strict=True):
        for one in pair:
            if len(chosen) < most:
                chosen.setdefault(one.hypothesis.key, [])
    fitted = {effect for effect, _ in chosen}
    for one in worth:
        name = one.hypothesis.effect.name
        if name not in fitted and one.promise >= ALIAS_SHARE * worth[0].promise:
            fitted.add(name)
            chosen[one.hypothesis.key] = []
    for one in worth:
        if one.hypothesis.key in chosen:
            chosen[one.hypothesis.key].append(one)
    return [one for laws in chosen.values() for one in laws]


def _refitted(study: Study, chosen: Sequence[Ranked], chi2: float, beside: Beside,
              chance: Chance, progress: Progress | None) -> list[Ranked]:
    """Each at its best amount, side by side; the same numbers as one after another."""
    study.projector(beside.named)  # made once, before all ask for it
    alone = [replace(study, workers=1, simulations=0) for _ in chosen]
    done: list[Ranked] = []

    def fitted(k: int) -> Ranked:
        one = refit(alone[k], chosen[k], chi2, beside.named)
        return supported(alone[k], one, beside, chance)

    with ThreadPoolExecutor(study.workers) as pool:
        for one in pool.map(fitted, range(len(chosen))):
            done.append(one)
            if progress:
                progress("refitting", len(done) / len(chosen))
    study.simulations += sum(one.simulations for one in alone)
    return done
