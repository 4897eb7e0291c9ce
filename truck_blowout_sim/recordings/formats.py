"""Files under the names of the channel table, read and written by their ending."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from pathlib import Path

from truck_blowout_sim.errors import InputError, quoted
from truck_blowout_sim.recordings.bag_export import Extra, write_bag
from truck_blowout_sim.recordings.bag_metadata import FILE_NAME
from truck_blowout_sim.recordings.bag_reader import read_bag
from truck_blowout_sim.recordings.csv_reader import read_csv
from truck_blowout_sim.recordings.csv_writer import write_csv
from truck_blowout_sim.recordings.logs import BAG_ENDINGS, READABLE
from truck_blowout_sim.recordings.logs.mat_log import variables_of
from truck_blowout_sim.recordings.mat_format import read_mat, write_mat
from truck_blowout_sim.recordings.mat_thesis import write_thesis_mat
from truck_blowout_sim.recordings.recording import Recording

BEGIN_MAPPING = "truck-blowout inspect LOG --write-map FILE begins one"
FOREIGN_ENDINGS = (".txt", ".tsv", ".asc", ".log", ".dat", ".vbo", ".mf4", ".mdf", ".mf3")
_WRITABLE = "a rosbag2 folder, .mcap, .csv or .mat"


def read_native(
    path: Path,
    *,
    tires: Iterable[str] = (),
    hubs: Iterable[str] = (),
    namespace: str | None = None,
    remap: Mapping[str, str] | None = None,
    source: str = "experiment",
) -> Recording:
    """Read a file that names its channels as the table does; arguments as in `read_recording`.

    Raises:
        InputError: one line: file, place, value, expectation.
    """
    _check_exists(path)
    suffix = path.suffix.lower()
    if path.is_dir() or path.name == FILE_NAME or suffix in BAG_ENDINGS:
        return read_bag(path, tires=tires, hubs=hubs, namespace=namespace, remap=remap)
    if suffix == ".csv":
        return read_csv(path, tires=tires, hubs=hubs)
    if suffix == ".mat":
        held = variables_of(path)
        return read_mat(path, source=source, tires=tires, hubs=hubs, held=held)
    if suffix in FOREIGN_ENDINGS:
        raise InputError("does not say which column is which channel", file=path,
                         expected=f"a mapping: --map FILE ({BEGIN_MAPPING})")  # fmt: skip
    raise InputError(f"ends in {quoted(path.suffix)}", file=path, expected=READABLE)


def write_recording(
    recording: Recording,
    path: str | os.PathLike[str],
    *,
    thesis_variables: bool = False,
    plain: bool = False,
    beside: Iterable[Extra] = (),
) -> Path:
    """Write a recording in the format that the path's ending names; a folder is a rosbag2 bag.

    The file or folder appears whole or not at all; one that is there already is replaced.

    Args:
        recording: what is written; every channel, in every format.
        path: a folder, or a file ending in ``.mcap``, ``.csv`` or ``.mat``.
        thesis_variables: of a ``.mat``: only the variables of the thesis's appendix A.
        plain: of a ``.csv``: without the lines of metadata before the header.
        beside: of a bag: further messages, in order of time.

    Returns:
        The path.

    Raises:
        InputError: an ending that is no format, or a folder that is no bag.
        StorageError: it cannot be written.
    """
    path = Path(path)
    suffix = path.suffix.lower()
    if suffix in ("", ".mcap"):
        write_bag(recording, path, beside)
    elif suffix == ".csv":
        write_csv(recording, path, plain=plain)
    elif suffix == ".mat":
        write = write_thesis_mat if thesis_variables else write_mat
        write(recording, path)
    else:
        raise InputError(f"ends in {quoted(path.suffix)}", file=path, expected=_WRITABLE)
    return path


def _check_exists(path: Path) -> None:
    try:
        path.stat()
    except OSError as error:
        raise InputError(
            (error.strerror or "cannot be opened").lower(), file=path, expected=READABLE
        ) from None
    if not os.access(path, os.R_OK):
        raise InputError("permission denied", file=path, expected="a readable file")
