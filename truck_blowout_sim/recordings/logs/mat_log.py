"""MATLAB files of any origin: vectors by name, those inside structures by path.

Version 5 to 7.2 by the reader of this package, 7.3 (HDF5) by h5py, an extra.

Known limits: objects (`table`, `timeseries`) are not read: save their vectors.
Validated with: test/recordings/test_logs_binary.py.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings.logs.log import Column, Table
from truck_blowout_sim.recordings.mat_file import Variable, read_variables

VERSION_7_3 = b"MATLAB 7.3"
HDF5 = b"\x89HDF\r\n\x1a\n"
_HDF5_AT = 512
_MOST_SAMPLES = 200_000_000
FloatArray = NDArray[np.float64]


def open_mat(path: Path) -> Table:
    """Read all vectors of a file.

    Raises:
        InputError: no MATLAB file, damaged, or 7.3 where h5py is not installed.
    """
    if is_hdf5(path):
        return _open_hdf5(path)
    return table_of(path, read_variables(path))


def variables_of(path: Path) -> dict[str, Variable]:
    """Top-level vectors of a file of any version, as the reader of version 5 gives them.

    Raises:
        InputError: no MATLAB file, or damaged.
    """
    if not is_hdf5(path):
        return read_variables(path)
    columns = _open_hdf5(path).columns
    return {name: Variable(name, c.values, f"{c.values.size} numbers")
            for name, c in columns.items() if "." not in name}  # fmt: skip


def table_of(path: Path, held: dict[str, Variable]) -> Table:
    """Variables that are read already, as a log; ``units.NAME`` texts are the units."""
    table = Table(path, "MATLAB 5 to 7.2", {})
    flat = {name: one for variable in held.values() for name, one in variable.flat()}
    texts = {name: one.text for name, one in flat.items() if one.text}
    for name, variable in flat.items():
        values = _vector(variable.values)
        if values is not None:
            table.columns[name] = Column(values, _unit(name, texts))
        elif not variable.text and not variable.inside and variable.name:
            table.notes.append(f"variable {name} is {variable.kind}: not read")
    return table


def is_hdf5(path: Path) -> bool:
    """Whether a file is one of MATLAB 7.3."""
    with path.open("rb") as file:
        head = file.read(_HDF5_AT + len(HDF5))
    return head.startswith((VERSION_7_3, HDF5)) or head[_HDF5_AT:] == HDF5


def _open_hdf5(path: Path) -> Table:
    try:
        import h5py
    except ImportError:
        raise InputError(
            "is MATLAB 7.3 (HDF5), for which h5py is needed", file=path,
            expected="pip install 'truck_blowout_sim[mat73]', or a file saved with -v7",
        ) from None
    table = Table(path, "MATLAB 7.3", {})
    try:
        with h5py.File(path, "r") as file:
            found = dict(_datasets(file, h5py))
            texts = {name: text for name, (_, text) in found.items() if text}
            for name, (values, text) in found.items():
                if values is not None and not text:
                    table.columns[name] = Column(values, _unit(name, texts))
    except Exception as error:  # noqa: BLE001 -- the library names damage in many ways
        words = str(error).splitlines()[0] if str(error) else type(error).__name__
        raise InputError(f"damaged: {words}", file=path, expected="a MATLAB 7.3 file") from None
    return table


def _datasets(group: Any, h5py: Any, prefix: str = "") -> Iterator[tuple[str, Any]]:  # noqa: ANN401
    """Vectors and texts of a group and the groups inside it, by path."""
    for key, item in group.items():
        name = f"{prefix}{key}"
        if key.startswith("#"):
            continue
        if isinstance(item, h5py.Group):
            yield from _datasets(item, h5py, name + ".")
        elif isinstance(item, h5py.Dataset) and item.dtype.kind in "iuf":
            if item.size > _MOST_SAMPLES:
                raise ValueError(f"{name} claims {item.size} numbers")
            text = item.attrs.get("MATLAB_class", b"") == b"char"
            values = np.asarray(item[()], dtype=np.float64)
            letters = "".join(map(chr, values.ravel().astype(int))) if text else ""
            yield name, (None if text else _vector(values), letters)


def _vector(values: FloatArray | None) -> FloatArray | None:
    if values is None or values.size < 2 or values.size != max(values.shape):
        return None
    return np.where(np.isfinite(values.ravel()), values.ravel(), np.nan)


def _unit(name: str, texts: dict[str, str]) -> str:
    """The unit that stands beside a vector: ``units.NAME``, ``NAME_unit``, ``PARENT.unit``."""
    parent = name.rpartition(".")[0]
    places = (f"units.{name}", f"{name}_unit", f"{name}_units", f"{parent}.unit",
              f"{parent}.units", f"{parent}.Unit", f"{parent}.Units")  # fmt: skip
    return next((texts[place] for place in places if place in texts), "")
