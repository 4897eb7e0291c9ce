"""What a diagnosis answers with: plain data, no computing.

``Diagnosis`` is the answer; ``write_diagnosis`` puts it down as ``diagnosis.json``. What a reader
needs to check it, and a page draws, hangs on it as ``Evidence``.

Validated with: test/report/test_result_json.py.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from truck_blowout_sim.comparison.plain_json import json_text
from truck_blowout_sim.diagnosis.result.evidence import Evidence
from truck_blowout_sim.diagnosis.result.parts import (
    VERDICTS,
    AliasSet,
    Effect,
    Fit,
    Location,
    Verdict,
)
from truck_blowout_sim.diagnosis.result.writing import encode_diagnosis
from truck_blowout_sim.recordings.atomic import replacing


@dataclass(frozen=True)
class Diagnosis:
    """The answer of a diagnosis.

    Attributes:
        verdict: one of ``VERDICTS``.
        sentence: the verdict in one sentence, for a person.
        effects: instruments first, then physics in the order of naming.
        alias_sets: one for each effect, in the same order.
        location: where model and truck differ; see ``Location``.
        train, holdout: how well the model fits, before and after.
        null_p_value: chance of as much evidence if nothing were missing; ``None`` if not asked.
        next_test: the run or channel that would decide, in words.
        evidence: what stands behind it.
    """

    verdict: Verdict
    sentence: str
    effects: tuple[Effect, ...] = ()
    alias_sets: tuple[AliasSet, ...] = ()
    location: Location = field(default_factory=Location)
    train: Fit = field(default_factory=Fit)
    holdout: Fit = field(default_factory=Fit)
    null_p_value: float | None = None
    next_test: str = ""
    evidence: Evidence = field(default_factory=Evidence)

    def __post_init__(self) -> None:
        if self.verdict not in VERDICTS:
            raise ValueError(f"verdict {self.verdict!r} is none of {', '.join(VERDICTS)}")
        if len(self.alias_sets) != len(self.effects):
            raise ValueError(
                f"{len(self.alias_sets)} alias sets for {len(self.effects)} effects: one each"
            )

    def as_json(self) -> Mapping[str, object]:
        """The public answer as plain objects, as ``diagnosis.json`` holds it."""
        return encode_diagnosis(self)


def write_diagnosis(diagnosis: Diagnosis, path: Path) -> None:
    """Write ``diagnosis.json``: the same bytes for the same answer, whole or not at all.

    Raises:
        ValueError: a number that must be finite is not; says which.
        StorageError: the file cannot be written.
    """
    text = json_text(diagnosis.as_json())
    with replacing(path) as temporary:
        temporary.write_text(text, encoding="utf-8", newline="\n")
