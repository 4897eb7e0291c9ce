"""The comparison as ``comparison.json``: the same bytes for the same runs.

Numbers are SI; ``display`` repeats the chief ones in the unit a person is shown. Null stands where
a channel has no noise that is known, or no shape that could be rated.

Validated with: test/comparison/test_comparing.py.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from truck_blowout_sim.comparison.contrast import Contrast
from truck_blowout_sim.comparison.errors import ChannelError
from truck_blowout_sim.comparison.iso18571 import Rating
from truck_blowout_sim.comparison.plain_json import json_text
from truck_blowout_sim.comparison.words import verdict
from truck_blowout_sim.recordings.atomic import replacing

if TYPE_CHECKING:
    from truck_blowout_sim.comparison.comparing import Comparison

Object = dict[str, object]


def write_comparison(comparison: Comparison, path: Path) -> None:
    """Write ``comparison.json``, whole or not at all.

    Raises:
        StorageError: it cannot be written.
    """
    text = json_text(encode_comparison(comparison))
    with replacing(path) as temporary:
        temporary.write_text(text, encoding="utf-8", newline="\n")


def encode_comparison(comparison: Comparison) -> Object:
    """The comparison as plain objects in the order of the file."""
    return {
        "recording": comparison.recording.name,
        "vehicle": comparison.vehicle.name,
        "verdict": verdict(comparison),
        "interval_s": list(comparison.interval_s),
        "speed_imposed": comparison.speed_imposed,
        "blowouts": [
            {"time_s": event.time_s, "tires": list(event.tires)}
            for event in comparison.recording.blowouts
        ],
        "mean_rating": comparison.mean_rating,
        "against": comparison.against,
        "contrast": _contrast(comparison.contrast) if comparison.contrast else None,
        "channels": {channel.name: _channel(channel) for channel in comparison.channels},
        "rebuilt": {
            name: {mark: marks.share(mark) for mark in ("stated", "derived", "interpolated")}
            for name, marks in comparison.marks.items()
        },
        "notes": list(comparison.notes),
    }


def _channel(channel: ChannelError) -> Object:
    scale = channel.unit.per_si
    return {
        "label": channel.label,
        "count": channel.count,
        "imposed": channel.imposed,
        "rms": channel.rms,
        "mean": channel.mean,
        "peak": channel.peak,
        "peak_time_s": channel.peak_time_s,
        "final": channel.final,
        "noise_sigma": channel.noise.value if channel.noise else None,
        "noise_source": channel.noise.source if channel.noise else None,
        "lag_s": channel.lag_s,
        "rms_sigma": channel.rms_sigma,
        "peak_sigma": channel.peak_sigma,
        "display": {
            "unit": channel.unit.symbol,
            "rms": channel.rms * scale,
            "peak": channel.peak * scale,
        },
        "iso_18571": _rating(channel.rating) if channel.rating else None,
    }


def _contrast(contrast: Contrast) -> Object:
    return {"rating": contrast.rating, "others": dict(contrast.others),
            "channels": list(contrast.channels), "separates": contrast.separates}  # fmt: skip


def _rating(rating: Rating) -> Object:
    return {
        "overall": rating.overall,
        "grade": rating.grade,
        "corridor": rating.corridor,
        "phase": rating.phase,
        "magnitude": rating.magnitude,
        "slope": rating.slope,
        "shift_s": rating.shift_s,
    }
