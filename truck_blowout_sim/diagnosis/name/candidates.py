"""Every effect at every place where it can act and could be seen in these runs."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

from truck_blowout_sim.diagnosis.case.emptying import began_to_empty_s
from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.effects import LIBRARY, Effect, secondary_blowout, yaw_rate_scale
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.result.parts import Place
from truck_blowout_sim.errors import InputError, nearest
from truck_blowout_sim.vehicle.schema.axle import CIRCUITS


def known_names(names: Collection[str]) -> tuple[str, ...]:
    """The same names in order, each once.

    Raises:
        InputError: one is no name of an effect.
    """
    known = {effect.name for effect in LIBRARY}
    for name in names:
        if name not in known:
            raise InputError(f"no effect is called {name!r}",
                             expected=nearest(name, sorted(known),
                                              "one of " + ", ".join(sorted(known))))
    return tuple(sorted(set(names)))


def considered(study: Study) -> tuple[Effect, ...]:
    """The library, less what was asked not to be considered."""
    return tuple(effect for effect in LIBRARY if effect.name not in study.settings.without)


def steady_candidates(study: Study) -> tuple[Hypothesis, ...]:
    """All hypotheses without an onset of their own that the training runs could show."""
    found = []
    for effect in considered(study):
        if effect.timing != "always":
            continue
        if not any(study.runs[i].shows(effect.applies) for i in study.train):
            continue
        neutral = effect.neutral(study.packed)
        found += [Hypothesis(effect, place, neutral)
                  for place in effect.places(study.packed.vehicle)
                  if _can_show(study, effect, place)]
    return tuple(found)


def _can_show(study: Study, effect: Effect, place: Place) -> bool:
    """Blowout effects act at tires that were blown, brake effects where pressure was applied.

    A gyro's gain is asked of the model only where kinematics could not tell it: a heading does.
    """
    runs = [study.runs[i] for i in study.train]
    if effect.name == yaw_rate_scale.EFFECT.name:
        rate, heading = f"{place.body}_yaw_rate_radps", f"{place.body}_yaw_rad"
        return any(rate in run.recording and heading not in run.recording for run in runs)
    if effect.applies == "blowout":
        return any(place.tire in event.tires for run in runs for event in run.recording.blowouts)
    if effect.applies == "brakes":
        circuit = place.axle if place.hub is None else (
            study.packed.vehicle.spec.axles[place.axle or ""].circuit)
        column = CIRCUITS.index(circuit or "steer")
        return any(run.braked[:, column].any() for run in runs)
    return True


def timed_effects(study: Study) -> tuple[Effect, ...]:
    """Effects that begin at an instant of their own."""
    return tuple(effect for effect in considered(study) if effect.timing != "always")


def failed_tires(study: Study, runs: Sequence[int]) -> Mapping[str, Mapping[str, float]]:
    """Tires whose recorded pressure falls without a command: {tire: {run: instant}}.

    None where that is not to be considered.
    """
    found: dict[str, dict[str, float]] = {}
    if secondary_blowout.EFFECT not in considered(study):
        return found
    for i in runs:
        run = study.runs[i]
        told = {tire for event in run.recording.blowouts for tire in event.tires}
        for tire in study.packed.vehicle.tires:
            name = f"tire_pressure_{tire}_pa"
            if tire in told or name not in run.recording:
                continue
            began = began_to_empty_s(run.recording[name])
            if began is not None:
                found.setdefault(tire, {})[run.recording.name] = began
    return found


def unwatched_tires(study: Study) -> tuple[Place, ...]:
    """One tire a hub that could fail unseen: its pressure is not recorded, it is not blown anyway.

    Twins on one hub leave nearly the same trace; the outer stands for both.
    """
    vehicle = study.packed.vehicle
    runs = [study.runs[i].recording for i in study.train]
    told = {tire for run in runs for event in run.blowouts for tire in event.tires}
    found: dict[str, Place] = {}
    for place in secondary_blowout.EFFECT.places(vehicle):
        seen = all(f"tire_pressure_{place.tire}_pa" in run for run in runs)
        if place.hub and not seen and place.tire not in told:
            found.setdefault(place.hub, place)
    return tuple(found.values())
