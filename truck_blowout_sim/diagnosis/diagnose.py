"""Diagnose: locate the mismatch, name the missing physics, model it, show the fit improve."""

from __future__ import annotations

import os
from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.algebra.threads import one_blas_thread
from truck_blowout_sim.diagnosis.answer.material import Material
from truck_blowout_sim.diagnosis.answer.outcome import answer
from truck_blowout_sim.diagnosis.answer.verdict import as_told, decide, shows_force
from truck_blowout_sim.diagnosis.case.antilock import MODE, as_braked
from truck_blowout_sim.diagnosis.case.calibration import calibrate
from truck_blowout_sim.diagnosis.case.fingerprints import case_parts
from truck_blowout_sim.diagnosis.case.names import names_apart
from truck_blowout_sim.diagnosis.case.recorded import Recorded
from truck_blowout_sim.diagnosis.case.resume import Keeps
from truck_blowout_sim.diagnosis.case.study import Progress, Study
from truck_blowout_sim.diagnosis.case.usable import check_each_once, determined
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.effort import USUAL, Effort
from truck_blowout_sim.diagnosis.fit.scatter import Scatter
from truck_blowout_sim.diagnosis.locate.comparable import Left
from truck_blowout_sim.diagnosis.locate.lagging import lagging_wheel
from truck_blowout_sim.diagnosis.locate.periodic import find_beat
from truck_blowout_sim.diagnosis.locate.posture import turned_body
from truck_blowout_sim.diagnosis.locate.restless import Unrest, unrest
from truck_blowout_sim.diagnosis.locate.wrench import Wrenches, missing_wrenches
from truck_blowout_sim.diagnosis.model.law import Law, plainest_law
from truck_blowout_sim.diagnosis.model.law_check import checked
from truck_blowout_sim.diagnosis.model.vehicle import (
    DiagnosedTruck,
    diagnosed_truck,
    driven_fit,
)
from truck_blowout_sim.diagnosis.name.candidates import known_names
from truck_blowout_sim.diagnosis.name.judging import Found, not_taken_back
from truck_blowout_sim.diagnosis.name.search import search
from truck_blowout_sim.diagnosis.prove.intervals import Timing, time_intervals
from truck_blowout_sim.diagnosis.prove.next_test import Separation, best_test
from truck_blowout_sim.diagnosis.prove.profile import Arms, arms_of
from truck_blowout_sim.diagnosis.prove.showing import would_show
from truck_blowout_sim.diagnosis.result import Diagnosis
from truck_blowout_sim.diagnosis.sensors import (
    GateResult,
    sensor_gate,
    vehicle_geometry,
)
from truck_blowout_sim.diagnosis.settings import load_settings
from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings import Recording
from truck_blowout_sim.simulation.plausible import DivergedError
from truck_blowout_sim.vehicle import Packed, Vehicle, load_vehicle, pack, write_vehicle

Floats = NDArray[np.float64]


@one_blas_thread
@determined
def diagnose(recordings: Sequence[Recording], *, baseline: Sequence[Recording] = (),
             holdout: Sequence[Recording] = (),
             vehicle: Vehicle | str = "international_9400i_trailmobile", settings: str = "default",
             effort: Effort = USUAL, workers: int | None = None, impose_speed: bool | None = None,
             without: Collection[str] = (), progress: Progress | None = None,
             kept: Keeps | None = None) -> tuple[Diagnosis, Mapping[str, float]]:
    """Diagnose recordings that a model does not reproduce.

    Args:
        recordings: training runs.
        baseline: runs of the same truck in which the effect is not at work.
        holdout: runs that are predicted only.
        vehicle: the model's vehicle, by name, path or loaded.
        settings: name of a file in ``config/diagnosis``.
        effort: how much work it may take; ``workers``: threads.
        impose_speed: follow the recorded speed; None: only where throttle or brakes are missing.
        without: effects that are known not to be the cause.
        progress: called with (stage, share).
        kept: knows simulations made before, as :func:`keeping` does those of an interrupted call.

    Returns:
        The diagnosis, and the diagnosed vehicle's packed parameters that differ from the given.

    Raises:
        InputError: no recording, one given twice, one that cannot drive the model, more than fit
            into memory, or no effect of such a name.
        OSError: the folder of ``kept`` cannot be written.
    """
    if not recordings:
        raise InputError("no recording to diagnose", expected="at least one recording")
    check_each_once({"fitted": recordings, "baseline": baseline, "only predicted": holdout})
    recordings, baseline, holdout = names_apart(recordings, baseline, holdout)
    loaded = load_vehicle(vehicle) if isinstance(vehicle, str) else vehicle
    given = pack(loaded)
    packed, lockup = as_braked(given, [*recordings, *baseline])
    rules = replace(load_settings(packed, settings), without=known_names(without))
    gate = sensor_gate(list(recordings), list(baseline), vehicle_geometry(loaded),
                       rules.alarms_by_instrument)
    rules = replace(rules, trial_step_s=rules.coarsest_step_s) if effort.coarse else rules
    if kept is not None:
        kept.begin(case_parts({"train": recordings, "baseline": baseline, "holdout": holdout},
                              packed, rules, (effort, impose_speed)))
    case = Recorded(recordings, baseline, holdout, packed, rules, effort, impose_speed,
                    workers or os.cpu_count() or 1, kept)

    def searched(gate: GateResult) -> tuple[Study, Found]:
        study = case.study(gate.findings)
        calibrate(study, progress=progress)
        return study, search(study, progress, effort.most_effects, sound=not gate.findings)

    study, found = searched(gate)
    believed = not_taken_back(gate, found)
    # all anew, for which a quick answer has no time
    if len(believed) < len(gate.findings) and not effort.coarse:
        gate = replace(gate, findings=believed)
        study, found = searched(gate)
    material = replace(_material(study, found, gate, loaded.name, effort, progress), lockup=lockup)
    told = answer(material)
    told, truck = _with_truck(told, material, case, given)
    return told, truck.values


def _material(study: Study, found: Found, gate: GateResult, vehicle: str,
              effort: Effort, progress: Progress | None) -> Material:
    """Everything else an answer needs, once the search has ended."""
    sound = not gate.findings  # what was corrected shows no more how a body stands or moves
    named = [r.hypothesis for r in found.named]
    before = _wrenches(study, found.models_null, (), progress)
    after = _wrenches(study, study.models, named, progress) if named else before
    scatter = found.chance.scatter if found.chance else Scatter.of(())
    material = Material(study, found, gate, before, after, _law(study, after),
                        _timings(study, found), vehicle,
                        _separation(study, found, progress) if effort.next_run else None,
                        _arms(study, found, progress) if effort.profile else {},
                        find_beat(study, named), lagging_wheel(study, named, scatter),
                        turned_body(study, named, scatter) if sound else None,
                        unrest(study, named) if sound else Unrest())
    if decide(material) in ("consistent", "miscalibrated"):
        material = replace(material, would_show=would_show(study, found.chance))
    if shows_force(material):
        told = as_told(material)
        material = replace(material, law=checked(told.study, _law(study, told.unnamed)))
    return material


def _law(study: Study, wrenches: Sequence[Wrenches]) -> Law:
    """Plainest law of the force that is missed most."""
    worst = max(wrenches, key=lambda w: w.delta)
    return plainest_law(worst, next(r for r in study.runs
                                    if r.recording.name == worst.history.recording))


def _wrenches(study: Study, models: Sequence[Floats], named: Sequence[Hypothesis],
              progress: Progress | None) -> tuple[Wrenches, ...]:
    """Missing wrench on each body in the training run that is explained worst."""
    return missing_wrenches(study, Left.of(study, models, named), models, named, progress)


def _timings(study: Study, found: Found) -> dict[tuple[str, str], Mapping[str, Timing]]:
    """Intervals of onset and duration of each timed effect, by run."""
    named = [r.hypothesis for r in found.named]
    return {r.hypothesis.key: time_intervals(study, r, [h for h in named if h is not r.hypothesis])
            for r in found.named if r.hypothesis.times}


def _arms(study: Study, found: Found, progress: Progress | None) -> dict[tuple[str, str], Arms]:
    """How well each named amount is known, the others in force."""
    named, arms = [r.hypothesis for r in found.named], {}
    for k, one in enumerate(found.named):
        others = [h for h in named if h is not one.hypothesis]
        arms[one.hypothesis.key] = arms_of(study, one, others)
        if progress:
            progress("profile", (k + 1) / len(named))
    return arms


def _separation(study: Study, found: Found, progress: Progress | None) -> Separation | None:
    """The run that would best tell apart what these cannot; None where nothing is in doubt."""
    named = [r.hypothesis for r in found.named]
    if progress and any(len(rivals) > 1 for rivals in found.rivals):
        progress("next test", 0.0)
    tried = (best_test(study, rivals, named) for rivals in found.rivals)
    return next((best for best in tried if best is not None), None)


def _diagnosed(material: Material, given: Packed) -> tuple[DiagnosedTruck, DiagnosedTruck]:
    """The calibrated truck without what was named, and with it."""
    told, law = as_told(material), None
    if shows_force(material) and material.law.helps:
        law = material.law.values
    study, found = told.study, told.found
    return (diagnosed_truck(study, given, found.models_null, ()),
            diagnosed_truck(study, given, study.models,
                            [r.hypothesis for r in found.named], law))


def _with_truck(told: Diagnosis, material: Material, case: Recorded, given: Packed
                ) -> tuple[Diagnosis, DiagnosedTruck]:
    """The answer with the truck that was judged: it is driven over the unseen runs.

    The instant of an event differs from run to run and is no property of a vehicle: where one was
    named, the figures stay those of the prediction, which locates it anew.
    """
    before, after = _diagnosed(material, given)
    if material.lockup is not None:
        after = replace(after, sources={**after.sources, MODE: material.lockup.sentence})
    evidence = replace(
        told.evidence, sources=tuple(after.sources.items()), findings=material.gate.findings,
        blowouts=tuple((r.name, event.time_s, " + ".join(event.tires))
                       for r in case.every
                       for event in r.blowouts))
    runs = [run.recording for run in material.study.holdout]
    if runs and not any(r.hypothesis.effect.timed for r in as_told(material).found.named):
        try:
            told = replace(told, holdout=driven_fit(
                runs, before.packed, case.packed.with_values(after.values),
                impose_speed=case.impose_speed, quanta=case.quanta))
        except DivergedError as error:
            note = f"{error}; the figures of unseen runs are those of the prediction"
            evidence = replace(evidence, notes=(*evidence.notes, note))
    return replace(told, evidence=evidence), after


def write_diagnosed_vehicle(path: Path, base: str, values: Mapping[str, float],
                            diagnosis: Diagnosis) -> None:
    """Write ``vehicle.yaml``: the given vehicle, extended by what was found."""
    nothing = "a cause of no list" if diagnosis.verdict == "unknown" else "calibration only"
    what = ", ".join(effect.name for effect in diagnosis.effects) or nothing
    write_vehicle(path, base, values, dict(diagnosis.evidence.sources),
                  title=f"{base}, diagnosed: {what}")


__all__ = ["Diagnosis", "diagnose", "write_diagnosed_vehicle"]
