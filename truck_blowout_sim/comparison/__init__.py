"""Model against recording: run on recorded inputs, errors, ratings."""

from __future__ import annotations

from truck_blowout_sim.comparison.comparing import Comparison, compare, compare_recordings
from truck_blowout_sim.comparison.driving import rms_errors
from truck_blowout_sim.comparison.errors import ChannelError
from truck_blowout_sim.comparison.iso18571 import Rating, rate
from truck_blowout_sim.comparison.result_json import encode_comparison, write_comparison
from truck_blowout_sim.comparison.words import verdict

__all__ = [
    "ChannelError",
    "Comparison",
    "Rating",
    "compare",
    "compare_recordings",
    "encode_comparison",
    "rate",
    "rms_errors",
    "verdict",
    "write_comparison",
]
