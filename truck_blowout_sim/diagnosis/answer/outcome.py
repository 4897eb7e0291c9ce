"""Put the answer together: verdict, effects in words, location, fit, evidence."""

from __future__ import annotations

from truck_blowout_sim.diagnosis.answer import evidence, words
from truck_blowout_sim.diagnosis.answer.cautions import cautions, worst_run
from truck_blowout_sim.diagnosis.answer.further_baseline import further_baseline
from truck_blowout_sim.diagnosis.answer.location import locate
from truck_blowout_sim.diagnosis.answer.material import Material
from truck_blowout_sim.diagnosis.answer.told import alias_set, physics_effect, sensor_effects
from truck_blowout_sim.diagnosis.answer.unlisted import listed
from truck_blowout_sim.diagnosis.answer.verdict import (
    as_told,
    chance_of_all,
    decide,
    only_unseen,
    shows_force,
)
from truck_blowout_sim.diagnosis.case.runs import parting_notes
from truck_blowout_sim.diagnosis.name.judging import Found
from truck_blowout_sim.diagnosis.result import AliasSet, Diagnosis, Evidence, Fit, Verdict
from truck_blowout_sim.simulation.flat import flat_notes
from truck_blowout_sim.simulation.silences import silences


def answer(material: Material) -> Diagnosis:
    """The diagnosis."""
    verdict, told, gate = decide(material), as_told(material), material.gate
    found = told.found
    effects = sensor_effects(gate.findings)
    named = [(r, rivals) for r, rivals in zip(found.named, found.rivals, strict=True)
             if r.hypothesis.effect.listed]
    effects += [physics_effect(r, material.study, material.timings.get(r.hypothesis.key),
                               material.arms.get(r.hypothesis.key)) for r, _ in named]
    aliases = [AliasSet(f.aliases or (f.name,), splits=f.next_test) for f in gate.findings]
    recorded = {c for run in material.study.runs for c in run.recording.channels}
    aliases += [alias_set(rivals, recorded) for _, rivals in named]
    return Diagnosis(
        verdict=verdict, sentence=words.verdict_sentence(
            verdict, effects, material.pulled, material.law if shows_force(material) else None,
            material.signs, cautions(material)),
        effects=tuple(effects), alias_sets=tuple(aliases), location=locate(material),
        train=fit(told, "train"), holdout=fit(told, "holdout"),
        null_p_value=chance_of_all(material, verdict),
        next_test=_next_test(material, verdict, found),
        evidence=gather(material, told))


def _next_test(material: Material, verdict: Verdict, found: Found) -> str:
    """What to record next, or to diagnose."""
    if verdict != "unknown":
        return words.next_test(found, material.gate, material.separation,
                               further_baseline(material.study))
    if only_unseen(material) and not material.signs:
        return words.train_on(worst_run(material)[0])
    return words.next_look(material.law, material.signs)


def fit(material: Material, role: str) -> Fit:
    """Rms residual in units of instrument noise, before and after, pooled over runs."""
    before = evidence.pooled(evidence.left_before(material.study, material.found, role))
    after = evidence.pooled(evidence.left_after(material.study, material.found, role))
    return Fit(before, after)


def _told_of(material: Material) -> tuple[str, ...]:
    """Channels that the signs of the answer are about."""
    posture = material.posture
    stands = () if posture is None else (f"{posture.body}_{posture.angle}_rad",)
    return (*(one.channel for one in (material.new_beat, material.moving_on) if one), *stands)


def gather(material: Material, told: Material) -> Evidence:
    """What stands behind the answer; ``told``: the material as it is told."""
    study, found = told.study, told.found
    rows = study.columns.shape[0]
    law = (material.law.equation,) if shows_force(material) else ()
    signs = tuple(one.equation for one in material.signs)
    old = (material.beat.ordinary,) if material.beat and not material.new_beat else ()
    about = _told_of(material)
    return Evidence(
        vehicle=material.vehicle,
        recordings=tuple((r.recording.name, r.role) for r in (*study.runs, *study.holdout)),
        candidates=evidence.candidates(found), would_show=material.would_show,
        maps=evidence.maps(study, found),
        overlays=evidence.overlays(study, found, about), about=about,
        forces=tuple(w.history for w in material.wrenches),
        beats=material.beat.scores if material.beat else None,
        calibrated=evidence.calibrated(study, told.joint_amounts),
        equations=tuple(words.equation_of(r.hypothesis, study.packed)
                        for r in listed(found.named)) + law + signs,
        assumptions=words.assumptions(study), missing_channels=words.missing_channels(study),
        notes=(*material.gate.notes, *old,
               *(note for r in study.runs
                 for note in (*r.recording.notes, *flat_notes(r.drive.initial.flat),
                              *silences(r.recording))),
               *parting_notes((*study.runs, *study.holdout))),
        facts=(*((f"unnamed wrench on the {w.history.body} buys", f"{w.delta:.0f} with {w.degrees}")
                 for w in told.unnamed),
               *(material.beat.facts if material.beat else ()),
               ("simulations", str(study.simulations)),
               ("sum of squares a row, calibrated", f"{found.chi2_null / rows:.3f}"),
               ("sum of squares a row, diagnosed", f"{found.chi2_after / rows:.3f}")))
