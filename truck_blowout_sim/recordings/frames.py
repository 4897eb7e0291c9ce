"""Recordings as pandas frames and xarray datasets, and back, with units.

Channels of different rates share one time base there: NaN where one has no sample. Units stand in
``frame.attrs["units"]`` and in each variable's ``attrs["units"]``, as xarray's own tools expect.

Validated with: test/recordings/test_frames.py.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings.names import parts_of
from truck_blowout_sim.recordings.recording import Blowout, Recording, Series

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr

TIME = "time_s"


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

    Raises:
        InputError: times that do not increase.
    """
    if TIME in frame.columns:
        frame = frame.set_index(TIME)
    times = np.asarray(frame.index, dtype=np.float64)
    columns = {str(name): np.asarray(frame[name], dtype=np.float64) for name in frame.columns}
    return _recording(times, columns, frame.attrs)


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

    Raises:
        InputError: times that do not increase.
    """
    times = np.asarray(dataset[TIME], dtype=np.float64)
    columns = {str(name): np.asarray(values, dtype=np.float64)
               for name, values in dataset.data_vars.items()}  # fmt: skip
    return _recording(times, columns, dataset.attrs)


def units_of(names: Iterable[str]) -> dict[str, str]:
    """Unit of each channel; empty for a name that is not in the table."""
    names = list(names)
    known = {channel.name: channel.unit for channel in parts_of(names).table()}
    return {name: known.get(name, "") for name in names}


def _recording(
    times: np.ndarray[Any, Any], columns: Mapping[str, Any], about: Mapping[Any, Any]
) -> Recording:
    channels = {}
    for name, values in columns.items():
        there = np.isfinite(values)
        try:
            channels[name] = Series(times[there], values[there])
        except ValueError as error:
            raise InputError(str(error), file="frame", where=f"column {name}",
                             expected="times that increase from row to row") from None  # fmt: skip
    events = tuple(Blowout(float(at), tuple(str(tires).split("+")))
                   for at, tires in zip(about.get("blowout_time_s", ()),
                                        about.get("blowout_tires", ()), strict=True))  # fmt: skip
    metadata = {str(key): str(text) for key, text in dict(about.get("metadata", {})).items()}
    return Recording(str(about.get("name", "frame")), channels, events, metadata)


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
