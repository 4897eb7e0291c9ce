"""Runs of a study: files with some keys changed, run, measured; a failure is a row as well."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from os import PathLike
from threading import Lock
from typing import Any

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.errors import InputError, quoted
from truck_blowout_sim.physics.layout import INPUT
from truck_blowout_sim.recordings import INPUT_NAMES
from truck_blowout_sim.resources import config_file
from truck_blowout_sim.simulation.abreast import execute_abreast, settle_all
from truck_blowout_sim.simulation.drive import Drive, Ran, names_of
from truck_blowout_sim.simulation.measures import Measures, measure
from truck_blowout_sim.simulation.plausible import diverged, implausible
from truck_blowout_sim.simulation.rates import check_delays
from truck_blowout_sim.simulation.run import prepare, row_times
from truck_blowout_sim.simulation.scenario import Scenario, scenario_of
from truck_blowout_sim.simulation.studies.design import Value
from truck_blowout_sim.simulation.studies.keys import (
    FILE,
    PARAMETER,
    SCENARIO,
    VEHICLE,
    Key,
    find_key,
)
from truck_blowout_sim.vehicle import Packed, pack
from truck_blowout_sim.vehicle.document import Branch, Place, read_document
from truck_blowout_sim.vehicle.given import AnyVehicle, packed_of
from truck_blowout_sim.vehicle.loading import vehicle_of
from truck_blowout_sim.vehicle.reading import unknown

Floats = NDArray[np.float64]
Case = tuple[int, Mapping[str, Value]]
OK, ROLLED_OVER, FAILED = "ok", "rolled over", "failed"
_KEPT_TRUCKS, _KEPT_STARTS = 32, 64


@dataclass(frozen=True, eq=False)
class Row:
    """What came out of one run.

    Attributes:
        number: of the run in the study.
        values: what was varied, as written.
        status: `OK`, `ROLLED_OVER` or `FAILED`; ``reason``: why it failed, in one line.
        measures: None where it failed.
        series: [n_rows, n_channels] on the study's time base, NaN after the run ended.
    """

    number: int
    values: Mapping[str, Value]
    status: str
    reason: str
    measures: Measures | None
    series: Floats


@dataclass(eq=False)
class Study:
    """A scenario and a vehicle, of which keys vary.

    Args:
        vehicle: a vehicle, one packed with parameters of its own, a path, or a shipped name.
        scenario: name of a shipped file, or a path.
        keys: what varies, as written.
        channels: outputs and inputs kept of each run.
        step_s: step [s].
        rate_hz: of the channels, and at which runs are measured.
        insist: also run what no truck does; else such a run fails with this reason.

    Raises:
        InputError: files that cannot be used, no such key or channel, a quantity under two keys,
            keys of the file of a vehicle that no longer says what its file says.
    """

    vehicle: AnyVehicle
    scenario: str | PathLike[str]
    keys: Sequence[str]
    channels: Sequence[str] = ()
    step_s: float = 0.001
    rate_hz: float = 100.0
    insist: bool = False
    _trucks: OrderedDict[Any, Packed] = field(default_factory=OrderedDict, init=False, repr=False)
    _starts: OrderedDict[Any, Floats] = field(default_factory=OrderedDict, init=False, repr=False)
    _lock: Any = field(default_factory=Lock, init=False, repr=False)

    def __post_init__(self) -> None:
        self._scenario_path = config_file("scenarios", self.scenario)
        self._scenario_tree = read_document(self._scenario_path, "scenarios")
        self._given = packed = packed_of(self.vehicle)
        tree = read_document(packed.vehicle.path, "vehicles")
        self.found: dict[str, Key] = {
            key: find_key(key, self._scenario_tree, tree, packed) for key in self.keys}
        _check_once(self.found.values())
        if any(key.where == VEHICLE for key in self.found.values()):
            _check_as_its_file(packed, tree)
        scenario = scenario_of(self._scenario_tree, self._scenario_path)
        self.times_s = row_times(scenario, self.step_s, self.rate_hz)
        try:
            prepare(packed, scenario, step_s=self.step_s, rate_hz=self.rate_hz)
        except InputError:
            # what varies may put it right: then each run says for itself whether it can be
            if not any(key.where in (SCENARIO, FILE) for key in self.found.values()):
                raise
        known = (*INPUT_NAMES, *names_of(packed.vehicle))
        for channel in self.channels:
            if channel not in known:
                raise _no_channel(channel, known)

    def __getstate__(self) -> dict[str, Any]:
        # to another process go the words; what was loaded is loaded anew there
        kept = ("vehicle", "scenario", "keys", "channels", "step_s", "rate_hz", "insist")
        return {key: getattr(self, key) for key in kept}

    def __setstate__(self, state: dict[str, Any]) -> None:
        Study.__init__(self, **state)

    def run(self, number: int, values: Mapping[str, Value]) -> Row:
        """Run one case; bad values and runs that diverge come back as a row with the reason."""
        return self.run_several([(number, values)])[0]

    def run_several(self, cases: Sequence[Case]) -> list[Row]:
        """As `run`, abreast where several cases are alike."""
        rows: dict[int, Row] = {}
        begun: dict[int, tuple[Packed, Scenario, Drive]] = {}
        for k, (number, values) in enumerate(cases):
            try:
                begun[k] = self.prepared(values)
            except InputError as error:
                rows[k] = self._failed(number, values, error)
        trucks, drives = [b[0] for b in begun.values()], [b[2] for b in begun.values()]
        ran = execute_abreast(trucks, drives, self._settled(trucks, drives))
        for (k, (packed, scenario, drive)), each in zip(begun.items(), ran, strict=True):
            number, values = cases[k]
            try:
                rows[k] = self._row(number, values, packed, scenario, drive, each)
            except InputError as error:
                rows[k] = self._failed(number, values, error)
        return [rows[k] for k in range(len(cases))]

    def _row(self, number: int, values: Mapping[str, Value], packed: Packed, scenario: Scenario,
             drive: Drive, ran: Ran) -> Row:
        """What came out of a case.

        Raises:
            InputError: the run diverged.
        """
        if ran.ending is not None and not ran.ending.rolled_over:
            raise diverged(packed, drive, ran.ending, scenario.name)
        measures = measure(packed, drive, ran, scenario.spec.lane_width_m)
        status = ROLLED_OVER if measures.rolled_over else OK
        return Row(number, values, status, "", measures,
                   self._series(packed, drive, ran, self._nothing()))

    def _failed(self, number: int, values: Mapping[str, Value], error: InputError) -> Row:
        return Row(number, values, FAILED, str(error), None, self._nothing())

    def _nothing(self) -> Floats:
        """Channels of a run that did not come about."""
        return np.full((self.times_s.size, len(self.channels)), np.nan)

    def prepared(self, values: Mapping[str, Value]) -> tuple[Packed, Scenario, Drive]:
        """Truck, scenario and drive with the values in place.

        Raises:
            InputError: values that cannot be used.
        """
        tree = self._scenario_tree
        for key, value in values.items():
            if self.found[key].where == SCENARIO:
                tree = self.found[key].put(tree, value)
        scenario = scenario_of(tree, self._scenario_path)
        packed, drive, _ = prepare(self._truck(values), scenario, step_s=self.step_s,
                                   rate_hz=self.rate_hz)
        last = {key: value for key, value in values.items()
                if self.found[key].where == PARAMETER}
        packed = packed.with_values(_numbers(last))
        check_delays(packed, self.step_s)
        if not self.insist and (found := implausible(packed, drive)):
            raise InputError(f"no vehicle of this kind does this: {'; '.join(found)}")
        return packed, scenario, drive

    def _truck(self, values: Mapping[str, Value]) -> Packed:
        """The packed truck; the last few are kept."""
        own = tuple((k, v) for k, v in values.items() if self.found[k].where in (VEHICLE, FILE))
        if not own:
            return self._given
        with self._lock:
            if own in self._trucks:
                self._trucks.move_to_end(own)
                return self._trucks[own]
        named = (str(v) for k, v in own if self.found[k].where == FILE)
        path = config_file("vehicles", next(named, self._given.vehicle.path))
        tree = read_document(path, "vehicles")
        for key, value in own:
            if self.found[key].where == VEHICLE:
                tree = self.found[key].within(tree).put(tree, value)
        packed = pack(vehicle_of(tree, path))
        self._keep(self._trucks, own, packed, _KEPT_TRUCKS)
        return packed

    def _settled(self, trucks: Sequence[Packed], drives: Sequence[Drive]) -> list[Floats]:
        """The settled trucks: equal trucks at equal starts settle once."""
        keys = [(truck.without_events().tobytes(), truck.topology.tobytes(), drive.initial,
                 drive.step_s) for truck, drive in zip(trucks, drives, strict=True)]
        known: dict[Any, Floats] = {}
        with self._lock:
            for key in keys:
                if key in self._starts:
                    self._starts.move_to_end(key)
                    known[key] = self._starts[key]
        new = list({key: k for k, key in enumerate(keys) if key not in known}.items())
        found = settle_all([trucks[k] for _, k in new], [drives[k] for _, k in new])
        for (key, _), start in zip(new, found, strict=True):
            known[key] = start
            self._keep(self._starts, key, start, _KEPT_STARTS)
        return [known[key] for key in keys]

    def _keep(self, kept: OrderedDict[Any, Any], key: object, value: object, most: int) -> None:
        with self._lock:
            kept[key] = value
            while len(kept) > most:
                kept.popitem(last=False)

    def _series(self, packed: Packed, drive: Drive, ran: Ran, out: Floats) -> Floats:
        """The channels on the study's time base; a shorter or longer run is cut or left NaN."""
        names = names_of(packed.vehicle)
        n = min(len(out), len(ran.out))
        good = np.isfinite(ran.out[:n, 0])
        for k, channel in enumerate(self.channels):
            if channel in INPUT_NAMES:
                rows = np.minimum(np.arange(n) * drive.every, len(ran.inputs) - 1)
                out[:n, k] = np.where(good, ran.inputs[rows, getattr(INPUT, channel)], np.nan)
            elif channel in names:
                out[:n, k] = ran.out[:n, names.index(channel)]
        return out


def _check_once(keys: Iterable[Key]) -> None:
    """Refuse one quantity under two keys, as in two units: the last would silently rule."""
    seen: dict[object, str] = {}
    for key in keys:
        if (first := seen.setdefault((key.where, key.paths), key.text)) != key.text:
            raise InputError(f"--vary {quoted(key.text)} is given twice, first as {quoted(first)}",
                             expected="each quantity once, in one unit")


def _check_as_its_file(packed: Packed, tree: Branch) -> None:
    """Refuse to vary keys of a file that a vehicle was changed from: the change would be lost."""
    path = packed.vehicle.path
    if packed.params.tobytes() != pack(vehicle_of(tree, path)).params.tobytes():
        raise InputError("the vehicle has other values than its file, of which keys vary",
                         file=path, expected="the vehicle as loaded, or packed names that vary")


def _numbers(values: Mapping[str, Value]) -> dict[str, float]:
    for key, value in values.items():
        if isinstance(value, str):
            raise InputError(f"--vary {key}: {value!r} is not a number", expected="a number in SI")
    return {key: float(value) for key, value in values.items()}


def _no_channel(channel: str, known: Sequence[str]) -> InputError:
    return unknown(Place("--channels", 0, ""), f"no channel {channel!r}", channel, tuple(known))
