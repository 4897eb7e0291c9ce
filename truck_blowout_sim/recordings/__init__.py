"""Recordings: the table of channels, recordings in memory, and their file formats."""

from __future__ import annotations

from truck_blowout_sim.recordings.bag_stream import BagStream
from truck_blowout_sim.recordings.bag_writer import BagWriter, WriterState
from truck_blowout_sim.recordings.channels import (
    ATMOSPHERE_PA,
    BLOWOUT_EVENT,
    DEFAULT_HUBS,
    DEFAULT_TIRES,
    INPUT_NAMES,
    Channel,
    Place,
    by_name,
    channels_for,
)
from truck_blowout_sim.recordings.encoder import RowEncoder
from truck_blowout_sim.recordings.formats import read_recording, write_recording
from truck_blowout_sim.recordings.recording import Blowout, Recording, Series

__all__ = [
    "ATMOSPHERE_PA",
    "BLOWOUT_EVENT",
    "DEFAULT_HUBS",
    "DEFAULT_TIRES",
    "INPUT_NAMES",
    "BagStream",
    "BagWriter",
    "Blowout",
    "Channel",
    "Place",
    "Recording",
    "RowEncoder",
    "Series",
    "WriterState",
    "by_name",
    "channels_for",
    "read_recording",
    "write_recording",
]
