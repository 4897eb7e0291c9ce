"""Recordings as pandas frames and xarray datasets, and back, with units.

Channels of different rates share one time base there: NaN where one has no sample. Units stand in
``frame.attrs["units"]`` and in each variable's ``attrs["units"]``, as xarray's own tools expect.

Validated with: test/recordings/test_frames.py.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.errors import InputError, nearest
from truck_blowout_sim.recordings.channels import by_name, channels_for
from truck_blowout_sim.recordings.names import parts_of
from truck_blowout_sim.recordings.recording import Blowout, Recording, Series
from truck_blowout_sim.recordings.units import SI_QUANTITIES, unit_for

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr

FloatArray = NDArray[np.float64]

TIME = "time_s"
_FILE = "frame"  # stands for a path in errors


def to_pandas(recording: Recording) -> pd.DataFrame:
    """A frame with one column a channel, indexed by ``time_s``.

    Raises:
        InputError: pandas is not installed.
    """
    pd = _library("pandas")
    columns = {n: pd.Series(s.value, index=s.time_s) for n, s in recording.channels.items()}
    frame = pd.DataFrame(columns).rename_axis(TIME)
    frame.attrs = {"units": units_of(recording.channels), **_about(recording)}
    return frame


def from_pandas(frame: pd.DataFrame) -> Recording:
    """The recording that a frame holds: a column a channel, NaN where it has no sample.

    Args:
        frame: indexed by ``time_s`` or with a column of that name.

    Units in ``frame.attrs["units"]`` are converted; a column without one is in SI.

    Raises:
        InputError: times that do not increase, an unknown channel or unit, text, or no numbers.
    """
    if TIME in frame.columns:
        frame = frame.set_index(TIME)
    stated = frame.attrs.get("units")
    units = dict(stated) if isinstance(stated, Mapping) else {}
    columns = {str(name): np.asarray(frame[name]) for name in frame.columns}
    return _recording(np.asarray(frame.index), columns, units, frame.attrs)


def to_xarray(recording: Recording) -> xr.Dataset:
    """A dataset with one variable a channel on the coordinate ``time_s``.

    Raises:
        InputError: xarray is not installed.
    """
    xr = _library("xarray")
    bases = [series.time_s for series in recording.channels.values()]
    times = np.unique(np.concatenate(bases)) if bases else np.zeros(0)
    units = units_of(recording.channels)
    variables = {}
    for name, series in recording.channels.items():
        values = np.full(times.size, np.nan)
        values[np.searchsorted(times, series.time_s)] = series.value
        variables[name] = (TIME, values, {"units": units[name]})
    coordinate = (TIME, times, {"units": "s"})
    return xr.Dataset(variables, coords={TIME: coordinate}, attrs=_about(recording))


def from_xarray(dataset: xr.Dataset) -> Recording:
    """The recording that a dataset holds; NaN where a channel has no sample.

    Each variable's ``attrs["units"]`` are converted; one without is in SI.

    Raises:
        InputError: times that do not increase, an unknown channel or unit, text, or no numbers.
    """
    if TIME not in dataset.variables:
        raise _refusal(f"no {TIME}", "", f"a coordinate {TIME}: seconds")
    units = {str(name): values.attrs.get("units", "")
             for name, values in dataset.variables.items()}  # fmt: skip
    columns = {str(name): np.asarray(values) for name, values in dataset.data_vars.items()}
    return _recording(np.asarray(dataset[TIME]), columns, units, dataset.attrs)


def units_of(names: Iterable[str]) -> dict[str, str]:
    """Unit of each channel; empty for a name that is not in the table."""
    names = list(names)
    known = {channel.name: channel.unit for channel in parts_of(names).table()}
    return {name: known.get(name, "") for name in names}


def _recording(
    times: NDArray[Any], columns: Mapping[str, NDArray[Any]], units: Mapping[Any, Any],
    about: Mapping[Any, Any],
) -> Recording:  # fmt: skip
    table = by_name(parts_of(columns).table())
    time_s = _in_si(times, str(units.get(TIME) or "s"), "time", TIME)
    channels = {}
    for name, values in columns.items():
        if name not in table:
            raise _refusal("is no channel", name, nearest(name, [*table, *by_name(channels_for())]))
        unit = table[name].unit
        told = _in_si(values, str(units.get(name) or unit), SI_QUANTITIES[unit], name)
        series = _series(time_s, told, name)
        if len(series):
            channels[name] = series
    if not channels:
        raise _refusal("holds no numbers", "", "a column of numbers for each channel")
    events = tuple(Blowout(float(at), tuple(str(tires).split("+")))
                   for at, tires in zip(about.get("blowout_time_s", ()),
                                        about.get("blowout_tires", ()), strict=True))  # fmt: skip
    metadata = {str(key): str(text) for key, text in dict(about.get("metadata", {})).items()}
    return Recording(str(about.get("name", "frame")), channels, events, metadata)


def _in_si(values: NDArray[Any], text: str, quantity: str, name: str) -> FloatArray:
    """A column's numbers in SI."""
    unit = unit_for(text, quantity, file=_FILE, where=f"column {name}")
    if values.dtype.kind in "mM":
        raise _refusal(f"holds {values.dtype}", name, "numbers")  # their float is nanoseconds
    try:
        numbers = np.asarray(values, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise _refusal(f"holds no numbers: {error}", name, "numbers") from None
    return np.asarray(unit.factor * numbers + unit.offset, dtype=np.float64)


def _series(time_s: FloatArray, values: FloatArray, name: str) -> Series:
    there = np.isfinite(values) if values.shape == time_s.shape else slice(None)
    try:
        return Series(time_s[there], values[there])
    except ValueError as error:
        raise _refusal(str(error), name, "times that increase from row to row") from None


def _refusal(problem: str, name: str, expected: str) -> InputError:
    return InputError(problem, file=_FILE, where=name and f"column {name}", expected=expected)


def _about(recording: Recording) -> dict[str, Any]:
    return {
        "name": recording.name,
        "blowout_time_s": [b.time_s for b in recording.blowouts],
        "blowout_tires": ["+".join(b.tires) for b in recording.blowouts],
        "metadata": dict(recording.metadata),
    }


def _library(name: str) -> Any:  # noqa: ANN401 -- a module
    from importlib import import_module

    try:
        return import_module(name)
    except ImportError:
        raise InputError(f"{name} is not installed",
                         expected="pip install 'truck_blowout_sim[frames]'") from None  # fmt: skip
