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
from truck_blowout_sim.recordings.formats import write_recording
from truck_blowout_sim.recordings.mapping import Rules, load_mapping
from truck_blowout_sim.recordings.reading import read_recording
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
    "Rules",
    "Series",
    "WriterState",
    "by_name",
    "channels_for",
    "load_mapping",
    "read_recording",
    "write_recording",
]
