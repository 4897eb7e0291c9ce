"""Which of the five verdicts the evidence supports, and how likely chance is to reach as much.

Validated with: test/diagnosis/test_outcome.py.
"""

from __future__ import annotations

from dataclasses import replace

from truck_blowout_sim.diagnosis.answer.material import Material
from truck_blowout_sim.diagnosis.answer.unlisted import listed, mostly_unlisted
from truck_blowout_sim.diagnosis.locate.left_over import (
    NAMING_SHARE,
    chance_of_more,
    excess,
    excess_of_all,
    expected_squares,
)
from truck_blowout_sim.diagnosis.name.trial import Fate
from truck_blowout_sim.diagnosis.result import Verdict


def decide(material: Material) -> Verdict:
    """Which of the five verdicts the evidence supports."""
    found, gate = material.found, material.gate
    physics = [r for r in listed(found.named) if r.hypothesis.effect.kind == "physics"]
    if (unexplained(material) or _beats(material) or material.posture
            or material.moving_on or material.lag or mostly_unlisted(found.named)):
        return "unknown"
    if physics:
        return "missing_physics"
    if gate.findings or found.named:
        return "sensor_artefact"
    off = material.pulled or material.lockup or untold(material)
    return "miscalibrated" if off else "consistent"


def _beats(material: Material) -> bool:
    """Whether a periodic force says more than everything named."""
    beat = material.new_beat
    return beat is not None and beat.evidence > material.bought


def unexplained(material: Material) -> bool:
    """Whether training keeps more than baseline, and what was named explains less than half.

    Less than half of training, and of training and the unseen runs together: these are asked, too,
    whether they keep more. Not asked without baseline runs, see `untold`.
    """
    if not material.study.baseline or not material.keeps_more:
        return False
    study, squares, bought = material.study, material.squares, material.bought
    if not material.found.named:  # also where unseen runs alone keep more
        return True
    usual = expected_squares(study, squares)
    if bought >= NAMING_SHARE * (excess(study, squares, usual) + bought):
        return False
    return excess_of_all(study, squares, usual) > (1.0 - NAMING_SHARE) * excess_of_all(
        study, material.squares_unnamed, usual)


def only_unseen(material: Material) -> bool:
    """Whether nothing is named, and only unseen runs keep more: training shows no force."""
    study, squares = material.study, material.squares
    return (not material.found.named and unexplained(material)
            and material.worst >= len(study.runs)
            and excess(study, squares, expected_squares(study, squares)) <= 0.0)


def shows_force(material: Material) -> bool:
    """Whether training shows a force that nothing named explains."""
    return unexplained(material) and not only_unseen(material)


def untold(material: Material) -> bool:
    """Whether far more is left than good models differ by, and no baseline run tells why.

    Instruments that drift, or a sheet of another truck, leave as much as missing physics does.
    """
    return not material.study.baseline and material.keeps_more


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
    settings, baseline = material.study.settings, bool(material.study.baseline)
    every = [material.found.p_value / material.study.alarms_by_name]
    if not material.gate.findings and baseline:
        every += [material.unrest.chance / settings.alarms_by_rest,
                  chance_of_more(material.study, material.squares) / settings.alarms_by_rest]
    if verdict in ("unknown", "sensor_artefact"):
        every.append(1.0)
    return min(min(every) * settings.false_alarms, 1.0)
