"""Options of every verb that reads a recording: `--map`, `--blow`, `--also`, `--namespace`.

A verb is decorated with `reads_logs`, takes ``logs: LogOptions`` among its parameters, and reads
through it; the four options then stand in its help.
"""

from __future__ import annotations

import functools
import inspect
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any, get_type_hints

import typer

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings import INPUT_NAMES, Recording, read_recording
from truck_blowout_sim.recordings.blowout_words import parse_blowouts
from truck_blowout_sim.recordings.mapping import load_mapping
from truck_blowout_sim.recordings.mapping.finish import with_blowouts
from truck_blowout_sim.recordings.mapping.opened import further_files
from truck_blowout_sim.recordings.shipped import find_recording

if TYPE_CHECKING:
    from truck_blowout_sim.vehicle import Vehicle

_OPTIONS: dict[str, tuple[Any, Any]] = {
    "mapping": (Path | None, typer.Option(
        None, "--map", "-m", metavar="FILE", help="Mapping file: which column or topic becomes"
        " which channel (`inspect LOG --write-map FILE` writes a first one).")),
    "blow": (list[str], typer.Option(
        [], "--blow", metavar="TIRE@SECONDS", help="A blowout that the log does not mark, on the"
        " recording's clock, e.g. steer_left@4.92; repeat for more.")),
    "also": (list[Path], typer.Option(
        [], "--also", metavar="FILE", help="A further file of the same test; repeat for more.")),
    "namespace": (str | None, typer.Option(
        None, help="Prefix of the truck's topics in a bag; /truck, or found by itself.")),
}  # fmt: skip


@dataclass(frozen=True)
class LogOptions:
    """What the user said about how a log is to be read.

    Attributes:
        mapping: mapping file.
        blow: ``TIRE@SECONDS`` words.
        also: further files of the same test.
        namespace: prefix of the truck's topics in a bag.
    """

    mapping: Path | None = None
    blow: tuple[str, ...] = ()
    also: tuple[Path, ...] = ()
    namespace: str | None = None

    @property
    def given(self) -> bool:
        """Whether anything was said."""
        return self != AS_IT_IS

    def inputs(self, *names: str | PathLike[str]) -> list[Path]:
        """Every file that reading these recordings reads, those that the mapping names included.

        Raises:
            InputError: the mapping file cannot be read.
        """
        recordings = [Path(name) for name in names]
        if self.mapping is None:
            return [*recordings, *self.also]
        rules = load_mapping(self.mapping)
        named = [place for name in names for place in further_files(find_recording(name), rules)]
        return [*recordings, *self.also, self.mapping, *named]

    def without_blowouts(self) -> LogOptions:
        """For runs of another kind than those of which ``--blow`` and ``--also`` speak."""
        return replace(self, blow=(), also=())

    def read(
        self, name: str | PathLike[str], vehicle: Vehicle | None = None, *,
        source: str = "experiment",
    ) -> Recording:
        """A recording by path or shipped name.

        Args:
            name: path, or name of a shipped recording.
            vehicle: knows the names of tires and hubs; None: the default truck's.
            source: which of the thesis's variables of a ``.mat``.

        Raises:
            InputError: one line: file, place, value, expectation.
        """
        return read_recording(
            find_recording(name), mapping=self.mapping, blow=parse_blowouts(self.blow),
            also=self.also, namespace=self.namespace, source=source, **_parts_of(vehicle),
        )  # fmt: skip

    def read_all(
        self, names: Sequence[str | PathLike[str]], vehicle: Vehicle | None = None,
        among: int = 1,
    ) -> list[Recording]:  # fmt: skip
        """Several recordings, each under a name of its own.

        Where there are several, here or ``among`` all that a verb reads, the mapping applies to
        those that it fits: one that names its channels as the table does, as a bag of the
        simulator, is read without, and a note says so. Blowouts apply to the recordings that
        mark none.

        Raises:
            InputError: one cannot be read; or ``--also``, which is of one test, and several.
        """
        if self.also and len(names) > 1:
            raise InputError(f"--also with {len(names)} recordings",
                             expected="one recording; or a mapping file with `also`")  # fmt: skip
        if len(names) == 1:
            read = self.read if among == 1 else self._read_where_it_fits
            return [read(names[0], vehicle)]
        reads = _apart([self._read_one_of_several(name, vehicle) for name in names], names)
        if among == 1:
            self.require_fit(reads)
        return reads

    def require_fit(self, recordings: Sequence[Recording]) -> None:
        """Refuse a mapping that fits none of all the recordings that a verb reads.

        Raises:
            InputError: with what is wrong in it.
        """
        said = [note for read in recordings for note in read.notes if _UNFIT in note]
        if said and len(said) == len(recordings):
            raise InputError(
                said[0].partition(_UNFIT)[2], file=self.mapping,
                expected="a mapping that fits at least one of the recordings",
            )  # fmt: skip

    def _read_one_of_several(self, name: str | PathLike[str], vehicle: Vehicle | None) -> Recording:
        return self._marked(replace(self, blow=())._read_where_it_fits(name, vehicle), vehicle)

    def _read_where_it_fits(
        self, name: str | PathLike[str], vehicle: Vehicle | None = None
    ) -> Recording:
        """With the mapping, or else without it under its own names."""
        try:
            return self.read(name, vehicle)
        except InputError as error:
            if self.mapping is None:
                raise
            try:
                read = replace(self, mapping=None).read(name, vehicle)
            except InputError:
                pass
            else:
                what = f"{error.where}: {error.problem}" if error.where else error.problem
                note = f"{read.name}: read under its own names, {_UNFIT}{what}"
                return replace(read, notes=(*read.notes, note))
            raise

    def _marked(self, recording: Recording, vehicle: Vehicle | None) -> Recording:
        if recording.blowouts or not self.blow:
            return recording
        return with_blowouts(recording, parse_blowouts(self.blow), **_parts_of(vehicle))


_UNFIT = "as the mapping does not fit: "

AS_IT_IS = LogOptions()
"""Nothing was said: the default of a verb's ``logs``."""


def reads_logs(command: Callable[..., None]) -> Callable[..., None]:
    """Add the options to a verb; it gets them as one ``logs: LogOptions``."""
    signature = inspect.signature(command)
    hints = get_type_hints(command)

    @functools.wraps(command)
    def wrapped(**values: Any) -> None:  # noqa: ANN401 -- typer has checked them
        said = {name: values.pop(name) for name in _OPTIONS}
        logs = LogOptions(said["mapping"], tuple(said["blow"]), tuple(said["also"]),
                          said["namespace"])  # fmt: skip
        command(**values, logs=logs)

    parameters: list[inspect.Parameter] = []
    for parameter in signature.parameters.values():
        if parameter.name == "logs":
            parameters += [_parameter(name) for name in _OPTIONS]
        else:
            parameters.append(parameter.replace(annotation=hints[parameter.name]))
    wrapped.__signature__ = signature.replace(parameters=parameters)  # type: ignore[attr-defined]
    wrapped.__annotations__ = {p.name: p.annotation for p in parameters}
    return wrapped


def apart_over_roles(groups: Sequence[Sequence[Recording]],
                     names: Sequence[Sequence[str | PathLike[str]]]) -> list[list[Recording]]:
    """The runs of each role, those of one name in several roles told apart by their paths too."""
    runs = _apart([run for group in groups for run in group], [one for own in names for one in own])
    left = iter(runs)
    return [[next(left) for _ in group] for group in groups]


def check_brakes(vehicle: Vehicle, *recordings: Recording) -> None:
    """Refuse brake pressures that the vehicle's brakes never have: another unit, or vehicle.

    Raises:
        InputError: there are some.
    """
    from truck_blowout_sim.simulation.plausible import too_much_pressure

    for recording in recordings:
        for name in INPUT_NAMES:
            if name.startswith("brake_pressure_") and name in recording:
                words = too_much_pressure(vehicle, float(recording[name].value.max(initial=0.0)))
                if words:
                    raise InputError(f"{name}: {words}", file=recording.name,
                                     expected="pressures of this vehicle's brakes; or a vehicle"
                                     " file with `brakes: hydraulic`")  # fmt: skip


def say_notes(*recordings: Recording) -> None:
    """Say on stderr what the reader had to assume or leave out."""
    for recording in recordings:
        name = f"{recording.name}: " if len(recordings) > 1 else ""
        for note in recording.notes:
            # some notes name the file already
            typer.echo(f"note: {name}{note.removeprefix(name)}", err=True)


def _parameter(name: str) -> inspect.Parameter:
    annotation, option = _OPTIONS[name]
    return inspect.Parameter(name, inspect.Parameter.POSITIONAL_OR_KEYWORD, default=option,
                             annotation=annotation)  # fmt: skip


def _parts_of(vehicle: Vehicle | None) -> dict[str, Any]:
    return {"hubs": vehicle.hubs, "tires": vehicle.tires} if vehicle else {}


def _apart(runs: Sequence[Recording], names: Sequence[str | PathLike[str]]) -> list[Recording]:
    """Recordings of one name told apart by their paths."""
    count = [sum(run.name == other.name for other in runs) for run in runs]
    return [run if alone == 1 else replace(run, name=f"{run.name} ({name})")
            for run, alone, name in zip(runs, count, names, strict=True)]  # fmt: skip
