"""Put the answer together: verdict, effects in words, location, fit, evidence."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
from scipy.stats import chi2

from truck_blowout_sim.diagnosis.algebra.quantiles import NINETY
from truck_blowout_sim.diagnosis.answer import evidence, words
from truck_blowout_sim.diagnosis.answer.further_baseline import further_baseline
from truck_blowout_sim.diagnosis.answer.told import alias_set, physics_effect, sensor_effects
from truck_blowout_sim.diagnosis.answer.unlisted import (
    Unlisted,
    listed,
    mostly_unlisted,
)
from truck_blowout_sim.diagnosis.case.antilock import Lockup
from truck_blowout_sim.diagnosis.case.runs import parting_notes
from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.fit.support import placed_in, unseen_with
from truck_blowout_sim.diagnosis.locate.beat import Beat
from truck_blowout_sim.diagnosis.locate.lagging import Lag
from truck_blowout_sim.diagnosis.locate.left_over import (
    NAMING_SHARE,
    chance_of_more,
    excess,
    excess_of_all,
    expected_squares,
    keeps_more,
    mean_squares,
)
from truck_blowout_sim.diagnosis.locate.posture import Posture
from truck_blowout_sim.diagnosis.locate.restless import Restless, Unrest
from truck_blowout_sim.diagnosis.locate.wrench import Wrenches
from truck_blowout_sim.diagnosis.model.law import Law
from truck_blowout_sim.diagnosis.name.judging import Found
from truck_blowout_sim.diagnosis.name.trial import Fate
from truck_blowout_sim.diagnosis.prove.intervals import Timing
from truck_blowout_sim.diagnosis.prove.next_test import Separation
from truck_blowout_sim.diagnosis.prove.profile import Arms
from truck_blowout_sim.diagnosis.result import (
    AliasSet,
    ChannelSigma,
    Diagnosis,
    Evidence,
    Fit,
    Location,
    Showing,
    Verdict,
    Wrench,
)
from truck_blowout_sim.diagnosis.result.evidence import FAR
from truck_blowout_sim.diagnosis.sensors import GateResult
from truck_blowout_sim.simulation.flat import flat_notes
from truck_blowout_sim.simulation.silences import silences

Key = tuple[str, str]  # of a hypothesis: name and place


@dataclass(frozen=True, eq=False)
class Material:
    """Everything an answer is made of.

    Attributes:
        wrenches: missing on each body before anything was named; ``unnamed``: after.
        law: plainest law of what is left unnamed.
        timings: intervals of each timed effect's onset and duration, by key and run.
        vehicle: name of the model's vehicle.
        separation: the run that would best tell apart what these cannot, if any could.
        arms: of each effect's amount by profile likelihood and jackknife, by key, if asked for.
        beat: a periodic force too fast for the bins; ``lag``: a wheel that a drag holds back;
            ``posture``: a body that stands turned; ``unrest``: a channel that nothing calms.
        lockup: a wheel that stood, so that the model goes without anti-lock control.
        would_show: smallest amounts that would be named, where nothing was.
    """

    study: Study
    found: Found
    gate: GateResult
    wrenches: tuple[Wrenches, ...]
    unnamed: tuple[Wrenches, ...]
    law: Law
    timings: Mapping[Key, Mapping[str, Timing]]
    vehicle: str
    separation: Separation | None = None
    arms: Mapping[Key, Arms] = field(default_factory=dict)
    beat: Beat | None = None
    lag: Lag | None = None
    posture: Posture | None = None
    unrest: Unrest = field(default_factory=Unrest)
    lockup: Lockup | None = None
    would_show: tuple[Showing, ...] = ()

    @cached_property
    def squares(self) -> tuple[float, ...]:
        """Squares a row that each run keeps with everything named in force, unseen runs last."""
        named = [r.hypothesis for r in self.found.named]
        placed = placed_in(self.study, named, [one.named for one in self.found.after])
        return mean_squares(self.study, named, unseen_with(self.study, placed))

    @cached_property
    def squares_unnamed(self) -> tuple[float, ...]:
        """The same with nothing named, of the same runs."""
        unnamed = replace(self.study, models=list(self.found.models_null))
        return mean_squares(unnamed, unseen=unnamed.holdout_models)[:len(self.squares)]

    @property
    def keeps_more(self) -> bool:
        """Whether training keeps more than chance lets it.

        Not asked beside a faulty instrument: once corrected, it leaves more of itself than models
        do.
        """
        return not self.gate.findings and keeps_more(self.study, self.squares)

    @property
    def signs(self) -> tuple[words.Sign, ...]:
        """What shows beside a force that has a name."""
        found = self.found
        shown = (*(Unlisted.of(r, rivals)
                   for r, rivals in zip(found.named, found.rivals, strict=True)
                   if not r.hypothesis.effect.listed),
                 self.new_beat, self.lag, self.posture, _moving_on(self))
        return tuple(one for one in shown if one is not None)

    @property
    def new_beat(self) -> Beat | None:
        """The beat, where baseline runs tell that it is new: every sound wheel beats a little."""
        return self.beat if self.study.baseline else None


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
    next_test = (words.next_look(material.law, material.signs) if verdict == "unknown"
                 else words.next_test(found, gate, material.separation,
                                      further_baseline(material.study)))
    return Diagnosis(
        verdict=verdict, sentence=words.verdict_sentence(
            verdict, effects, pulled(material), material.law if unexplained(material) else None,
            material.signs, cautions(material)),
        effects=tuple(effects), alias_sets=tuple(aliases), location=locate(material),
        train=fit(told, "train"), holdout=fit(told, "holdout"),
        null_p_value=chance_of_all(material, verdict), next_test=next_test,
        evidence=gather(material, told))


def cautions(material: Material) -> tuple[str, ...]:
    """Sentences beside the verdict, whatever it is."""
    said = () if material.lockup is None else (material.lockup.sentence,)
    if untold(material):
        return (*said, words.left_untold(material.squares))
    return (*said, _left_beside_names(material)) if _more_beside_names(material) else said


def _more_beside_names(material: Material) -> bool:
    """Whether training keeps more than baseline though a name stands, which explains most of it."""
    return (bool(material.study.baseline) and decide(material) == "missing_physics"
            and material.keeps_more)


def _left_beside_names(material: Material) -> str:
    """Which run keeps most, and how much more than baseline runs do."""
    study, squares = material.study, material.squares
    asked = [*study.train, *range(len(study.runs), len(squares))]
    worst = max(asked, key=lambda i: squares[i])
    run = [*study.runs, *study.holdout][worst]
    return words.left_beside_names(
        run.recording.name, float(np.sqrt(squares[worst] / expected_squares(study, squares))))


def as_told(material: Material) -> Material:
    """The material with the effects that the answer names in force: none where it is `unknown`.

    What explains less than half of a mismatch is no name for it; it stays among the candidates.
    Where only candidates without a name are in force, they stay in force.
    """
    study, found = material.study, material.found
    if not listed(found.named) or decide(material) != "unknown":
        return material
    keys = {ranked.hypothesis.key for ranked in found.named}
    tried = [replace(trial, fate=Fate("withheld")) if trial.ranked.hypothesis.key in keys
             else trial for trial in found.tried]
    return replace(
        material, study=replace(study, models=list(found.models_null)), unnamed=material.wrenches,
        found=replace(found, named=[], rivals=[], tried=tried, chi2_after=found.chi2_null,
                      after=found.before))


def chance_of_all(material: Material, verdict: Verdict) -> float:
    """Chance that any of the tests is led so far where nothing is missing.

    Each counts by its share of the false alarms (Bonferroni with weights), so what is stated comes
    out below ``false_alarms``. Of a sign beside a force only that it passed is known.
    """
    settings = material.study.settings
    every = [material.found.p_value / settings.alarms_by_name]
    if not material.gate.findings and material.study.baseline:
        every += [material.unrest.chance / settings.alarms_by_rest,
                  chance_of_more(material.study, material.squares) / settings.alarms_by_rest]
    if verdict in ("unknown", "sensor_artefact"):
        every.append(1.0)
    return min(min(every) * settings.false_alarms, 1.0)


def decide(material: Material) -> Verdict:
    """Which of the five verdicts the evidence supports."""
    found, gate = material.found, material.gate
    physics = [r for r in listed(found.named) if r.hypothesis.effect.kind == "physics"]
    if (unexplained(material) or _beats(material) or material.posture
            or _moving_on(material) or material.lag or mostly_unlisted(found.named)):
        return "unknown"
    if physics:
        return "missing_physics"
    if gate.findings or found.named:
        return "sensor_artefact"
    off = pulled(material) or material.lockup or untold(material)
    return "miscalibrated" if off else "consistent"


def _beats(material: Material) -> bool:
    """Whether a periodic force says more than everything named."""
    beat = material.new_beat
    return beat is not None and beat.evidence > _bought(material)


def _moving_on(material: Material) -> Restless | None:
    """The restless channel, if more is left of it than everything named explains of all."""
    moving = material.unrest.channel
    return moving if moving is not None and moving.evidence > _bought(material) else None


def _told_of(material: Material) -> tuple[str, ...]:
    """Channels that the signs of the answer are about."""
    posture = material.posture
    stands = () if posture is None else (f"{posture.body}_{posture.angle}_rad",)
    return (*(one.channel for one in (material.new_beat, _moving_on(material)) if one), *stands)


def unexplained(material: Material) -> bool:
    """Whether training keeps more than baseline, and what was named explains less than half.

    Less than half of training, and of training and the unseen runs together: these are asked, too,
    whether they keep more. Not asked without baseline runs, see `untold`.
    """
    if not material.study.baseline or not material.keeps_more:
        return False
    study, squares, bought = material.study, material.squares, _bought(material)
    usual = expected_squares(study, squares)
    if bought >= NAMING_SHARE * (excess(study, squares, usual) + bought):
        return False
    left = excess_of_all(study, squares, usual)
    return not material.found.named or left > (1.0 - NAMING_SHARE) * excess_of_all(
        study, material.squares_unnamed, usual)


def untold(material: Material) -> bool:
    """Whether far more is left than good models differ by, and no baseline run tells why.

    Instruments that drift, or a sheet of another truck, leave as much as missing physics does.
    """
    return not material.study.baseline and material.keeps_more


def _bought(material: Material) -> float:
    """Fall of the sum of squares that the named effects brought.

    With what calibration had ascribed to the sheet: a dragging flat tire is also a number of it.
    """
    found = material.found
    return found.chi2_null - found.chi2_after + sum(
        max(r.evidence - r.delta, 0.0) for r in found.named)


def pulled(material: Material) -> list[tuple[str, float]]:
    """Sheet numbers far from the sheet, with their pull, strongest first."""
    study = material.study
    own = joint_amounts(material)
    total = {n.name: own.get(n.name, 0.0) for n in study.settings.nuisances}
    return sorted(((n, a) for n, a in total.items() if abs(a) > FAR), key=lambda p: -abs(p[1]))


def joint_amounts(material: Material) -> dict[str, float]:
    """Each nuisance in the joint fit, in prior sigmas, the named effects in force."""
    study, named = material.study, [r.hypothesis for r in material.found.named]
    amounts = study.projector(named).amounts(study.residual())
    return {study.names[k]: float(a) for k, a in zip(study.kept(named), amounts, strict=True)}


def locate(material: Material) -> Location:
    """Channels that differ before anything is named; where what is then left unnamed acts."""
    study = material.study
    before = fit(material, "train").before
    channels = tuple(ChannelSigma(n, s) for n, s in sorted(before.items(), key=lambda p: -p[1])
                     if s > 1.5)
    if not material.wrenches:
        return Location(channels=channels)
    # along the course both bodies move as one: what turns or beats says which it is, or what was
    # named, by its wheels
    shown: list[str | None] = [
        one.body for one in (material.posture, material.new_beat, _moving_on(material)) if one]
    bodies = shown or [r.hypothesis.place.body for r in material.found.named[:1]]
    best = max(material.wrenches, key=lambda w: (w.history.body in bodies, w.delta))
    history = best.history
    z = (np.abs(history.fx_n / history.fx_sigma_n) + np.abs(history.fy_n / history.fy_sigma_n)
         + np.abs(history.mz_nm / history.mz_sigma_nm))
    strong = np.flatnonzero(z > 0.5 * z.max()) if z.size else np.zeros(0, dtype=int)
    least = chi2.isf(study.settings.false_alarms, best.degrees)
    if best.delta < least or not strong.size:
        return Location(channels=channels)
    a, b = strong[0], strong[-1] + 1
    wide = NINETY * best.x_sigma_m
    known = np.isfinite(best.x_m)
    return Location(
        channels=channels,
        interval_s=(float(history.time_s[a]) - 0.5 * best.window_s,
                    float(history.time_s[b - 1]) + 0.5 * best.window_s),
        body=history.body, line_of_action_x_m=best.x_m if known else None,
        line_of_action_ci90_m=(best.x_m - wide, best.x_m + wide) if known else None,
        wrench=Wrench(float(history.fx_n[a:b].mean()), float(history.fy_n[a:b].mean()),
                      float(history.mz_nm[a:b].mean())))


def fit(material: Material, role: str) -> Fit:
    """Rms residual in units of instrument noise, before and after, pooled over runs."""
    before = evidence.pooled(evidence.left_before(material.study, material.found, role))
    after = evidence.pooled(evidence.left_after(material.study, material.found, role))
    return Fit(before, after)


def gather(material: Material, told: Material) -> Evidence:
    """What stands behind the answer; ``told``: the material as it is told."""
    study, found = told.study, told.found
    rows = study.columns.shape[0]
    law = (material.law.equation,) if unexplained(material) else ()
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
        calibrated=evidence.calibrated(study, joint_amounts(told)),
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
