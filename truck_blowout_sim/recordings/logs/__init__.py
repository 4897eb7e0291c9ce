"""Logs of other people's loggers, read as named columns; what they mean is said by a mapping."""

from __future__ import annotations

from pathlib import Path

from truck_blowout_sim.errors import InputError, quoted
from truck_blowout_sim.recordings.bag_metadata import FILE_NAME
from truck_blowout_sim.recordings.logs.bag_log import open_bag_log
from truck_blowout_sim.recordings.logs.csv_log import open_csv
from truck_blowout_sim.recordings.logs.log import Column, Log, Table
from truck_blowout_sim.recordings.logs.mat_log import open_mat
from truck_blowout_sim.recordings.logs.mdf_log import open_mdf
from truck_blowout_sim.recordings.logs.vbo_log import open_vbo

__all__ = ["BAG_ENDINGS", "READABLE", "Column", "Log", "Table", "open_log"]

BAG_ENDINGS = (".mcap", ".db3", ".bag")
READABLE = "a rosbag2 folder, .mcap, .db3, .bag, .csv, .txt, .vbo, .mat or MDF (.mf4, .mdf, .dat)"
_TEXT = (".csv", ".txt", ".tsv", ".asc", ".log", ".dat")
_MDF = (".mf4", ".mdf", ".mf3")


def open_log(path: Path) -> Log:
    """Open a log of any format by its ending; a `.dat` is MDF or text, as its first bytes say.

    Raises:
        InputError: no such format, or damaged.
    """
    suffix = path.suffix.lower()
    if path.is_dir() or path.name == FILE_NAME or suffix in BAG_ENDINGS:
        return open_bag_log(path)
    if suffix in _MDF or (suffix == ".dat" and path.read_bytes()[:3] == b"MDF"):
        return open_mdf(path)
    if suffix == ".vbo":
        return open_vbo(path)
    if suffix == ".mat":
        return open_mat(path)
    if suffix in _TEXT:
        return open_csv(path)
    raise InputError(f"ends in {quoted(path.suffix)}", file=path, expected=READABLE)
