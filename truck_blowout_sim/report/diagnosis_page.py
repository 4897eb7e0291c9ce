"""The report of a diagnosis: one page that a forensic engineer could put in a file.

Validated with: test/report/test_diagnosis_page.py.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from truck_blowout_sim.comparison.words import labels_for
from truck_blowout_sim.diagnosis.result import Diagnosis, summarize
from truck_blowout_sim.report.diagnosis_pictures import diagnosis_pictures
from truck_blowout_sim.report.diagnosis_rows import (
    calibrated_row,
    candidate_row,
    effect_row,
    location_rows,
    ranked,
    showing_row,
)
from truck_blowout_sim.report.page import render, write_text
from truck_blowout_sim.vehicle import Vehicle

_VERDICTS = {
    "consistent": ("consistent", "good"),
    "miscalibrated": ("miscalibrated: the spec sheet's numbers are off", "bad"),
    "sensor_artefact": ("an instrument, not the vehicle", "bad"),
    "missing_physics": ("missing physics", "bad"),
    "unknown": ("unknown cause", "bad"),
}
_ROLES = (("Training", "train"), ("Holdout, never fitted", "holdout"), ("Baseline", "baseline"))
_PRINTED_CANDIDATES, _PRINTED_NUMBERS = 10, 15
_HEADS: tuple[Mapping[str, object], ...] = (
    {"key": "where", "words": "where", "number": False},
    {"key": "amount", "words": "amount", "number": False},
    {"key": "gain", "words": "evidence Δχ²", "number": True},
    {"key": "p", "words": "p", "number": True},
)


def write_diagnosis_report(diagnosis: Diagnosis, vehicle: Vehicle, path: Path,
                           brief: bool = False) -> None:
    """Write the page; it needs no other file.

    Args:
        brief: only the pictures that are printed, and of each role only the worst map.

    Raises:
        StorageError: it cannot be written.
    """
    write_text(diagnosis_page(diagnosis, vehicle, brief), path)


def diagnosis_page(diagnosis: Diagnosis, vehicle: Vehicle, brief: bool = False) -> str:
    """The page as HTML.

    Args:
        diagnosis: the answer with its evidence.
        vehicle: the vehicle as given, for its geometry and the names of its channels.
        brief: see :func:`write_diagnosis_report`.
    """
    labels = labels_for(vehicle)
    evidence, words = diagnosis.evidence, _VERDICTS[diagnosis.verdict]
    pictures = diagnosis_pictures(diagnosis, vehicle, labels, brief)
    effects = [
        effect_row(effect, aliases, diagnosis.effects)
        for effect, aliases in zip(diagnosis.effects, diagnosis.alias_sets, strict=True)
    ]
    said = {str(effect["equation"]) for effect in effects}
    candidates = [candidate_row(c) for c in ranked(evidence.candidates)]
    calibrated = [calibrated_row(c) for c in evidence.calibrated]
    return render("diagnosis.html", {
        "summary": summarize(diagnosis, lambda channel: labels.get(channel, channel)),
        "verdict_words": words[0],
        "verdict_class": words[1],
        "vehicle": evidence.vehicle or vehicle.name,
        "vehicle_title": vehicle.title,
        "recordings": _recordings(diagnosis),
        "facts": evidence.facts,
        "effects": effects,
        "equations": [line for line in evidence.equations if line not in said],
        "next_test": diagnosis.next_test,
        "worst": pictures.worst,
        "truck": pictures.truck,
        "location": location_rows(diagnosis.location, labels),
        "maps": pictures.maps,
        "forces": pictures.forces,
        "beats": pictures.beats,
        "candidates": candidates,
        "candidate_heads": [h for h in _HEADS if any(row[str(h["key"])] for row in candidates)],
        "printed_candidates": _PRINTED_CANDIDATES,
        "would_show": [showing_row(one) for one in evidence.would_show],
        "candidates_picture": pictures.candidates,
        "fit": pictures.fit,
        "overlays": pictures.overlays,
        "calibrated": calibrated,
        "calibrated_units": any(row["unit"] for row in calibrated),
        "moved": [row for row in calibrated if row["far"]][:_PRINTED_NUMBERS],
        "pulls": pictures.pulls,
        "missing_channels": [(labels.get(n, n), w) for n, w in evidence.missing_channels],
        "assumptions": evidence.assumptions,
        "notes": evidence.notes,
    })  # fmt: skip


def _recordings(diagnosis: Diagnosis) -> list[tuple[str, str]]:
    found = []
    for words, role in _ROLES:
        names = [name for name, used in diagnosis.evidence.recordings if used == role]
        if names:
            found.append((words, ", ".join(names)))
    return found
