"""MATLAB files of any origin: vectors by name, those inside structures by path.

Version 5 to 7.2 by the reader of this package, 7.3 (HDF5) by h5py, an extra.

Known limits: objects (`table`, `timetable`, `timeseries`) are not read, as their form is not
public: a note says how to save their vectors.
Validated with: test/recordings/test_logs_binary.py.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
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
_MOST_PARTS = 20_000
_MOST_COLUMNS = 64  # of a matrix of signals; a wider one is an image or a map
_TIMES = ("time", "t", "timestamp", "timestamps", "time_s")
_LARGEST_STEP_S = 0.5
_SAVE = "s = table2struct(T, 'ToScalar', true); save('log.mat', '-struct', 's')"
_WAYS_OUT = {
    "table": f"T = {{}}; {_SAVE}",
    "timetable": f"T = timetable2table({{}}); T.(1) = seconds(T.(1)); {_SAVE}",
    "duration": "t = seconds({}); save('log.mat', 't', '-append')",
    "datetime": "t = posixtime({}); save('log.mat', 't', '-append')",
    "timeseries": "t = {0}.Time; x = {0}.Data; save('log.mat', 't', 'x')",
}
_OF_OTHERS = "save the vectors inside {}"
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
        vectors = _vectors(name, variable.values)
        for path_of, values in vectors:
            table.columns[path_of] = Column(values, _unit(name, texts))
        if not vectors and not variable.text and not variable.inside and variable.name:
            table.notes.append(f"variable {name} is {variable.kind}: not read{_way_out(variable)}")
    return _checked(path, _with_own_times(table))


def _way_out(variable: Variable) -> str:
    """What to do in MATLAB so that an object can be read."""
    if not variable.kind.startswith("an object"):
        return ""
    words = _WAYS_OUT.get(variable.kind.rpartition(" ")[2], _OF_OTHERS)
    return f"; in MATLAB: {words.format(variable.name)}"


def _checked(path: Path, table: Table) -> Table:
    """Refuse a file without numbers; where everything is an object, with the way out."""
    objects = [note for note in table.notes if " is an object" in note]
    if objects and not table.columns:
        problem, _, way = objects[0].partition(": not read; ")
        raise InputError(problem, file=path, expected=f"vectors or a structure; {way}")
    if not table.columns:
        raise InputError("no vector of numbers in it", file=path,
                         expected="vectors of two or more numbers, one of them the time")
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
            texts = {name: one.text for name, one in found.items() if one.text}
            for name, one in found.items():
                for path_of, values in _vectors(name, one.values):
                    table.columns[path_of] = Column(values, _unit(name, texts))
                if one.kind.startswith("an object"):
                    table.notes.append(f"variable {name} is {one.kind}: not read{_way_out(one)}")
    except Exception as error:  # noqa: BLE001 -- the library names damage in many ways
        words = str(error).splitlines()[0] if str(error) else type(error).__name__
        raise InputError(f"damaged: {words}", file=path, expected="a MATLAB 7.3 file") from None
    return _checked(path, _with_own_times(table))


def _datasets(group: Any, h5py: Any, prefix: str = "") -> Iterator[tuple[str, Variable]]:  # noqa: ANN401
    """Vectors, texts and objects of a group and of what is inside it, by path."""
    for key, item in group.items():
        if key.startswith("#"):
            continue
        if isinstance(item, h5py.Group):
            yield from _datasets(item, h5py, f"{prefix}{key}.")
        elif isinstance(item, h5py.Dataset):
            yield from _dataset(item, h5py, prefix, key)


def _dataset(item: Any, h5py: Any, prefix: str, key: str) -> Iterator[tuple[str, Variable]]:  # noqa: ANN401
    """One variable, or the entries of a cell array or structure array, which are references."""
    name = f"{prefix}{key}"
    if item.size > _MOST_SAMPLES:
        raise ValueError(f"{name} claims {item.size} numbers")
    kind = item.attrs.get("MATLAB_class", b"")
    if "MATLAB_object_decode" in item.attrs and kind not in (b"function_handle", b"struct"):
        yield name, Variable(name, None, f"an object of class {kind.decode('ascii', 'replace')}")
    elif item.dtype.kind in "iuf":
        text = kind == b"char"
        values = np.asarray(item[()], dtype=np.float64)
        letters = "".join(map(chr, values.ravel().astype(int))) if text else ""
        # HDF5 counts the axes from the other end
        yield name, Variable(name, None if text else values.T, "numbers", letters)
    elif h5py.check_ref_dtype(item.dtype) is not None:
        yield from _referenced(item, h5py, prefix, key)


def _referenced(item: Any, h5py: Any, prefix: str, key: str) -> Iterator[tuple[str, Variable]]:  # noqa: ANN401
    references = np.asarray(item[()]).ravel()
    if references.size > _MOST_PARTS:
        raise ValueError(f"{prefix}{key} claims {references.size} entries")
    cell = item.attrs.get("MATLAB_class", b"") == b"cell"
    for entry, reference in enumerate(references, 1):
        # as in version 5: cells{2}, log(2).speed
        before, last = (prefix, f"{key}{{{entry}}}") if cell else (
            f"{prefix.removesuffix('.')}({entry}).", key)  # fmt: skip
        held = item.file[reference] if reference else None
        if isinstance(held, h5py.Group):
            yield from _datasets(held, h5py, f"{before}{last}.")
        elif isinstance(held, h5py.Dataset) and h5py.check_ref_dtype(held.dtype) is None:
            yield from _dataset(held, h5py, before, last)


def _vectors(name: str, values: FloatArray | None) -> list[tuple[str, FloatArray]]:
    """A vector under its name; the columns of a matrix as MATLAB names them, ``name(:,2)``."""
    if values is None or values.size < 2:
        return []
    found = np.where(np.isfinite(values), values, np.nan)
    if values.size == max(values.shape):
        return [(name, found.ravel())]
    if values.ndim != 2 or not values.shape[1] < min(values.shape[0], _MOST_COLUMNS + 1):
        return []
    return [(f"{name}(:,{k + 1})", found[:, k]) for k in range(values.shape[1])]


def _with_own_times(table: Table) -> Table:
    """Where several structures hold a time of their own in seconds, what is inside is on it."""
    clocks = {name.rpartition(".")[0]: name for name, column in table.columns.items()
              if name.rpartition(".")[2].lower() in _TIMES and _in_seconds(column)}
    clocks.pop("", None)
    if len(clocks) < 2:
        return table
    columns: dict[str, Column] = {}
    for name, column in table.columns.items():
        if name in clocks.values():
            continue
        times = {clocks[parent]: table.columns[clocks[parent]].values
                 for parent in _parents(name) if parent in clocks}  # fmt: skip
        fitting = [(clock, t) for clock, t in times.items() if t.size == column.values.size]
        columns[name] = replace(column, times=dict(fitting[:1]))
    return replace(table, columns=columns)


def _parents(name: str) -> Iterator[str]:
    """Structures that a vector is in, the inmost first: ``a.b``, ``a`` of ``a.b.c``."""
    while name := name.rpartition(".")[0]:
        yield name


def _in_seconds(column: Column) -> bool:
    """Whether a column counts on in steps that can only be seconds."""
    steps = np.diff(column.values)
    return bool(steps.size and (steps >= 0.0).all() and 0.0 < np.median(steps) < _LARGEST_STEP_S)


def _unit(name: str, texts: dict[str, str]) -> str:
    """The unit that stands beside a vector: ``units.NAME``, ``NAME_unit``, ``PARENT.unit``."""
    parent = name.rpartition(".")[0]
    places = (f"units.{name}", f"{name}_unit", f"{name}_units", f"{parent}.unit",
              f"{parent}.units", f"{parent}.Unit", f"{parent}.Units")  # fmt: skip
    return next((texts[place] for place in places if place in texts), "")
