"""Sentences that stand beside a verdict: what it leaves open.

Validated with: test/diagnosis/test_outcome.py.
"""

from __future__ import annotations

import numpy as np

from truck_blowout_sim.diagnosis.answer import words
from truck_blowout_sim.diagnosis.answer.material import Material
from truck_blowout_sim.diagnosis.answer.verdict import decide, untold
from truck_blowout_sim.diagnosis.locate.left_over import expected_squares


def cautions(material: Material) -> tuple[str, ...]:
    """Sentences beside the verdict, whatever it is."""
    study, names = material.study, decide(material) == "missing_physics"
    said = [] if material.lockup is None else [material.lockup.sentence]
    if untold(material):
        said.append(words.left_untold(material.squares))
    elif names and study.baseline and material.keeps_more:
        said.append(_left_beside_names(material))
    if names and study.parts_of_one_log:
        said.append(words.ONE_LOG)
    return tuple(said)


def _left_beside_names(material: Material) -> str:
    """Which run keeps most, and how much more than baseline runs do."""
    study, squares = material.study, material.squares
    asked = [*study.train, *range(len(study.runs), len(squares))]
    worst = max(asked, key=lambda i: squares[i])
    run = [*study.runs, *study.holdout][worst]
    return words.left_beside_names(
        run.recording.name, float(np.sqrt(squares[worst] / expected_squares(study, squares))))
