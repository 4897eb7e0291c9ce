"""MATLAB files with the thesis's variables: mph, deg/s, ft in SAE axes; SI and ISO axes inside.

Variables (appendix A of the thesis): ``time_e vx_e vy_e yaw_e x_e y_e`` for the experiment, the
same with ``_h`` for HVE. ``yaw`` is the yaw *rate*. SAE axes have y right and z down, so lateral
speed, yaw rate and lateral position change sign; forward ones do not. One exception: the thesis's
script flips ``y_e`` before it plots and subtracts ``y_h`` from it as it stands, so ``y_h`` is taken
to point left already.

References: thesis, appendix A (plotting script).
Known limits: MATLAB 7.3 (HDF5) files are refused; save with ``-v7``.
Validated with: test/recordings/test_mat_format.py.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.errors import InputError, quoted
from truck_blowout_sim.recordings.atomic import replacing
from truck_blowout_sim.recordings.channels import by_name, channels_for
from truck_blowout_sim.recordings.checks import check_times, check_values, without_glitches
from truck_blowout_sim.recordings.mat_file import Variable, read_variables
from truck_blowout_sim.recordings.recording import Blowout, Recording, Series
from truck_blowout_sim.recordings.units import FOOT_M, MILE_PER_HOUR_MPS

FloatArray = NDArray[np.float64]

DEGREE_IN_RAD = math.pi / 180.0
BLOWN_TIRE = "steer_left"
SOURCES = {"experiment": "_e", "hve": "_h"}
_SAMPLES, _START_S, _STEP_S = 1499, -4.92, 0.01


@dataclass(frozen=True)
class _Variable:
    stem: str
    channel: str
    factor: float
    flips: bool


_VARIABLES = (
    _Variable("vx", "tractor_vx_mps", MILE_PER_HOUR_MPS, False),
    _Variable("vy", "tractor_vy_mps", MILE_PER_HOUR_MPS, True),
    _Variable("yaw", "tractor_yaw_rate_radps", DEGREE_IN_RAD, True),
    _Variable("x", "tractor_x_m", FOOT_M, False),
    _Variable("y", "tractor_y_m", FOOT_M, True),
)

THESIS_CHANNELS = frozenset(variable.channel for variable in _VARIABLES)
"""Channels that have a variable in the thesis's files."""


def read_thesis_mat(
    path: Path, *, source: str = "experiment", held: Mapping[str, Variable] | None = None
) -> Recording:
    """Read the experiment's or HVE's variables.

    The clock's zero is the blowout of the left steer tire, as in the thesis.

    Args:
        path: a MATLAB file, version 5 to 7.2.
        source: ``experiment`` or ``hve``.
        held: the file's variables, where they are read already.

    Raises:
        InputError: no MATLAB file, a variable missing, of wrong type or length, or not finite.
    """
    if source not in SOURCES:
        names = " or ".join(SOURCES)
        raise InputError(f"source {quoted(source)}", file=path, expected=names)
    suffix = SOURCES[source]
    held = read_variables(path) if held is None else held
    notes = ["mph, deg/s, ft in SAE axes converted to SI in ISO axes (y left, yaw to the left)"]
    time_s = _times(path, held, suffix, notes)
    table = by_name(channels_for((), ()))
    channels = {}
    for variable in _VARIABLES:
        name = variable.stem + suffix
        if name not in held:
            continue
        values = _vector(path, held, name) * variable.factor * _sign(variable, suffix)
        _check_length(path, name, values, time_s)
        channel = table[variable.channel]
        check_values(channel, values, file=path, where=partial(_where, name))
        channels[channel.name] = Series(*without_glitches(channel, time_s, values, notes))
    if not channels:
        wanted = ", ".join(v.stem + suffix for v in _VARIABLES)
        raise InputError(
            f"none of the variables (found {', '.join(held) or 'nothing'})",
            file=path,
            expected=f"time{suffix} and {wanted}",
        )
    blowouts = (Blowout(0.0, (BLOWN_TIRE,)),) if time_s[0] <= 0.0 <= time_s[-1] else ()
    if blowouts:
        notes.append("blowout of steer_left at time 0, the origin of the thesis's clock")
    return Recording(path.stem, channels, blowouts, {"source": source}, tuple(notes))


def write_thesis_mat(recording: Recording, path: Path, *, source: str = "experiment") -> None:
    """Write the variables that the thesis's script loads, on the time base of ``tractor_vx_mps``.

    Raises:
        InputError: there is no forward speed in the recording.
    """
    suffix = SOURCES[source]
    if "tractor_vx_mps" not in recording:
        raise InputError(
            "has no channel tractor_vx_mps",
            file=recording.name,
            expected="a tractor's speed: the thesis's .mat files are on its time base",
        )
    time_s = recording["tractor_vx_mps"].time_s
    variables: dict[str, FloatArray] = {f"time{suffix}": time_s[:, None]}
    for variable in _VARIABLES:
        if variable.channel in recording:
            values = recording.at(variable.channel, time_s) / variable.factor
            if np.isfinite(values).all():
                column = values[:, None] * _sign(variable, suffix)
                variables[variable.stem + suffix] = column
    from scipy.io import savemat  # slow to load, and few need it

    with replacing(path) as temporary, temporary.open("wb") as file:
        savemat(file, variables)


def has_thesis_variables(names: Iterable[str]) -> bool:
    """Whether a file with these variables is one of the thesis's."""
    known = {v.stem + suffix for v in _VARIABLES for suffix in SOURCES.values()}
    return bool(known & set(names))


def _sign(variable: _Variable, suffix: str) -> float:
    if suffix == SOURCES["hve"] and variable.stem == "y":
        return 1.0
    return -1.0 if variable.flips else 1.0


def _times(path: Path, held: Mapping[str, Variable], suffix: str, notes: list[str]) -> FloatArray:
    for name in (f"time{suffix}", "time_e"):
        if name in held:
            time_s = _vector(path, held, name)
            if not np.isfinite(time_s).all():
                i = int(np.flatnonzero(~np.isfinite(time_s))[0])
                where = _where(name, i)
                raise InputError(f"time {time_s[i]}", file=path, where=where, expected="seconds")
            check_times(time_s, file=path, where=partial(_where, name))
            return time_s
    present = [v.stem + suffix for v in _VARIABLES if v.stem + suffix in held]
    lengths = {_vector(path, held, name).size for name in present}
    if lengths == {_SAMPLES}:
        notes.append(f"no time variable: {_SAMPLES} samples from {_START_S} s, {_STEP_S} s apart")
        return np.round(_START_S + _STEP_S * np.arange(_SAMPLES), 9)
    raise InputError(
        f"no variable time{suffix} (found {', '.join(held) or 'nothing usable'})",
        file=path,
        expected=f"time{suffix} in seconds",
    )


def _vector(path: Path, held: Mapping[str, Variable], name: str) -> FloatArray:
    values = held[name].values
    if values is None or values.size != max(values.shape, default=0) or values.size < 2:
        raise InputError(
            f"is {held[name].kind}",
            file=path,
            where=f"variable {name}",
            expected="a vector of two real numbers or more",
        )
    return values.ravel()


def _check_length(path: Path, name: str, values: FloatArray, time_s: FloatArray) -> None:
    if values.size != time_s.size:
        raise InputError(
            f"{values.size} samples",
            file=path,
            where=f"variable {name}",
            expected=f"{time_s.size}, as the time has",
        )


def _where(name: str, i: int) -> str:
    return f"variable {name}, sample {i + 1}"
