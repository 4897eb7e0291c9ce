"""Sentences that stand beside a verdict: what it leaves open.

Validated with: test/diagnosis/test_outcome.py.
"""

from __future__ import annotations

import numpy as np

from truck_blowout_sim.diagnosis.answer import words
from truck_blowout_sim.diagnosis.answer.material import Material
from truck_blowout_sim.diagnosis.answer.verdict import decide, only_unseen, untold
from truck_blowout_sim.diagnosis.locate.left_over import expected_squares


def cautions(material: Material) -> tuple[str, ...]:
    """Sentences beside the verdict, whatever it is."""
    study, names = material.study, decide(material) == "missing_physics"
    said = [] if material.lockup is None else [material.lockup.sentence]
    if untold(material):
        said.append(words.left_untold(material.squares))
    elif only_unseen(material):
        said.append(words.only_unseen(*worst_run(material)))
    elif names and study.baseline and material.keeps_more:
        said.append(words.left_beside_names(*worst_run(material)))
    if names and study.parts_of_one_log:
        said.append(words.ONE_LOG)
    return tuple(said)


def worst_run(material: Material) -> tuple[str, float]:
    """Which run that was to be explained keeps most, and how much more than baseline runs do."""
    study, squares, worst = material.study, material.squares, material.worst
    run = [*study.runs, *study.holdout][worst]
    return run.recording.name, float(np.sqrt(squares[worst] / expected_squares(study, squares)))
