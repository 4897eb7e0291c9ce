"""One page that shows how model and record differ.

Validated with: test/report/test_comparison_page.py.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from truck_blowout_sim.comparison import (
    ChannelError,
    Comparison,
    Rating,
    verdict,
    write_comparison,
)
from truck_blowout_sim.comparison.provenance import MARKS, Marks
from truck_blowout_sim.recordings.atomic import replacing_all
from truck_blowout_sim.report.comparison_figures import comparison_pictures
from truck_blowout_sim.report.page import render, write_pictures, write_text
from truck_blowout_sim.report.style import Picture
from truck_blowout_sim.simulation.replay import speed_is_missing

PAGE, DATA, FIGURES = "report.html", "comparison.json", "figures"
_METADATA = ("test", "vehicle", "road", "tractor_base_link", "trailer_base_link", "accelerometers",
             "tractor_accelerometers", "trailer_accelerometers")
_ABSENT = "–"


def write_comparison_report(comparison: Comparison, folder: Path) -> Path:
    """Write the page, its figures as PNG and the numbers as JSON.

    Returns:
        The page, ``report.html``; beside it ``comparison.json`` and ``figures/``.

    Raises:
        StorageError: a file cannot be written; then none is.
    """
    pictures = comparison_pictures(comparison)
    with replacing_all(folder) as temporary:
        write_pictures(pictures, temporary / FIGURES)
        write_comparison(comparison, temporary / DATA)
        write_text(comparison_page(comparison, pictures), temporary / PAGE)
    return folder / PAGE


def comparison_page(comparison: Comparison, pictures: tuple[Picture, ...] | None = None) -> str:
    """The page as HTML that needs no other file."""
    recording = comparison.recording
    start, end = comparison.interval_s
    headline, _, more = verdict(comparison).partition("; ")
    return render("comparison.html", {
        "name": recording.name,
        "other": comparison.other,
        "of_recordings": comparison.of_recordings,
        "vehicle": comparison.vehicle.name,
        "vehicle_title": comparison.vehicle.title,
        "verdict": headline,
        "more": more[:1].upper() + more[1:],
        "rebuilt": recording.metadata.get("origin", "") if comparison.marks else "",
        "interval": f"{start:.2f} s to {end:.2f} s",
        "blowouts": _blowouts(comparison),
        "metadata": [(key.replace("_", " "), recording.metadata[key]) for key in _METADATA
                     if key in recording.metadata],
        "driven_by": _driven_by(comparison),
        "notes": comparison.notes,
        "pictures": comparison_pictures(comparison) if pictures is None else pictures,
        "marks": [_mark_row(name, marks) for name, marks in comparison.marks.items()],
        "channels": [_row(channel) for channel in comparison.channels],
    })  # fmt: skip


def _blowouts(comparison: Comparison) -> str:
    events = comparison.recording.blowouts
    return ", ".join(f"{' + '.join(event.tires)} at {event.time_s:.2f} s" for event in events)


def _driven_by(comparison: Comparison) -> str:
    """What the model was given; empty where no model ran."""
    if comparison.of_recordings:
        return ""
    if comparison.speed_imposed:
        missing = speed_is_missing(comparison.recording, comparison.vehicle)
        why = "because throttle or brake pressures were not recorded" if missing else "as asked"
        return f"the recorded hand-wheel angle; the recorded speed is imposed, {why}"
    return "the recorded hand-wheel angle, throttle and brake control pressures"


def _row(channel: ChannelError) -> Mapping[str, object]:
    sigma = _ABSENT if channel.rms_sigma is None else f"{channel.rms_sigma:.1f}"
    cells = [
        channel.shown(channel.rms),
        channel.shown(channel.peak),
        f"{channel.peak_time_s:.2f} s",
        sigma,
        _ABSENT if channel.lag_s is None else f"{channel.lag_s:+.2f} s",
        *_rating_cells(channel.rating),
    ]
    return {
        "name": channel.name, "label": channel.label, "imposed": channel.imposed, "cells": cells
    }  # fmt: skip


def _rating_cells(rating: Rating | None) -> list[str]:
    if rating is None:
        return [_ABSENT] * 5
    scores = (rating.corridor, rating.phase, rating.magnitude, rating.slope)
    return [
        f"{rating.overall:.2f} {rating.grade}",
        *(f"{score:.2f}" for score in scores),
    ]


def _mark_row(name: str, marks: Marks) -> Mapping[str, str]:
    shares = {mark: f"{marks.share(mark):.0%}" for mark in MARKS}
    return {"name": name, **shares, "sources": "; ".join(marks.sources) or _ABSENT}
