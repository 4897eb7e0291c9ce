"""Calibrate: fit the numbers of a vehicle's sheet to ordinary driving.

The runs are taken as runs in which nothing is missing. Every number of the sheet has a prior; the
runs move those that they can tell, and the others stay at the sheet. What belongs to the place of
a test (slope, crossfall, grip of its road) is fitted beside them and written nowhere.

References: Gauss-Newton with Gaussian priors (A. Tarantola, Inverse Problem Theory, 2005,
section 3.4).
Known limits: intervals by curvature; numbers that move alike share their interval; an effect that
is at work in every run is fitted by the numbers that resemble it most.
Validated with: test/diagnosis/test_calibrate.py.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.comparison import rms_errors
from truck_blowout_sim.diagnosis.algebra.linear import Projector
from truck_blowout_sim.diagnosis.algebra.quantiles import NINETY
from truck_blowout_sim.diagnosis.algebra.threads import one_blas_thread
from truck_blowout_sim.diagnosis.case.antilock import MODE, Lockup, as_braked
from truck_blowout_sim.diagnosis.case.calibration import apply_amounts
from truck_blowout_sim.diagnosis.case.calibration import calibrate as settle
from truck_blowout_sim.diagnosis.case.names import names_apart
from truck_blowout_sim.diagnosis.case.runs import parting_notes, prepare_run
from truck_blowout_sim.diagnosis.case.study import FURTHEST, Study
from truck_blowout_sim.diagnosis.case.usable import check_each_once, determined
from truck_blowout_sim.diagnosis.nuisance import Nuisance, unit_of
from truck_blowout_sim.diagnosis.sensors import (
    SensorFinding,
    correct,
    seen_quanta,
    sensor_gate,
    vehicle_geometry,
)
from truck_blowout_sim.diagnosis.settings import Settings, load_settings
from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings import Recording
from truck_blowout_sim.vehicle import Packed, Vehicle, load_vehicle, pack, write_vehicle

Floats = NDArray[np.float64]
Progress = Callable[[str, float], None]

_STEP_S = 0.002  # bins of 0.1 s hardly depend on it, but where friction sticks and slips
# of the settings' steps: a coast-down of a minute tells a drag to a hundredth of the steps that a
# diagnosis takes, over which speed is no straight line
_FINER = 0.1
_SHARES = (1.0, 0.5, 0.25)  # of the way to the numbers that the runs ask for


@dataclass(frozen=True)
class SheetNumber:
    """A number of the sheet after calibration.

    Attributes:
        name: of the number.
        kind: ``scale``: ``change`` is a share of the sheet's value; ``add``: it is added, in SI.
        change: from the sheet; 0 where the runs cannot tell.
        ci90: 90 % interval of the change.
        prior_sigma: how far it strays from truck to truck, 1 sigma; ``source``: who says so.
        values: of the packed parameters that it stands for, as calibrated.
        told: the runs say more about it than the sheet does.
        of_the_place: it belongs to the road of the test and not to the vehicle.
        at_prior_end: it stopped at three prior sigmas; the runs ask for more.
    """

    name: str
    kind: str
    change: float
    ci90: tuple[float, float]
    prior_sigma: float
    source: str
    values: Mapping[str, float]
    told: bool
    of_the_place: bool
    at_prior_end: bool


@dataclass(frozen=True)
class ChannelChange:
    """How well a channel of a run is predicted with the sheet and with the calibrated vehicle.

    Attributes:
        recording, channel: which; ``unseen``: the run was not fitted.
        before, after: rms error, SI.
    """

    recording: str
    channel: str
    unseen: bool
    before: float
    after: float


@dataclass(frozen=True)
class Calibration:
    """A calibrated vehicle.

    Attributes:
        vehicle: name of the sheet's vehicle.
        runs, holdout: names of the runs that were fitted, and only predicted.
        numbers: all numbers of the sheet, those that moved most of their prior first.
        changes: by run and channel.
        instruments: faults that were found in the instruments, and taken out.
        packed: the calibrated truck.
        notes: what a user must know.
        share: of the way to where linear sensitivities point that was gone; 0: the sheet was kept.
        lockup: a wheel that stood, so that the calibrated truck goes without anti-lock control.
    """

    vehicle: str
    runs: tuple[str, ...]
    holdout: tuple[str, ...]
    numbers: tuple[SheetNumber, ...]
    changes: tuple[ChannelChange, ...]
    instruments: tuple[SensorFinding, ...]
    packed: Packed
    notes: tuple[str, ...] = ()
    share: float = 1.0
    lockup: Lockup | None = None

    @property
    def told(self) -> tuple[SheetNumber, ...]:
        """Numbers of the vehicle that the runs tell."""
        return tuple(n for n in self.numbers if n.told and not n.of_the_place)

    @property
    def untold(self) -> tuple[SheetNumber, ...]:
        """Numbers that stay at the sheet."""
        return tuple(n for n in self.numbers if not n.told)

    def error_ratio(self, *, unseen: bool) -> float | None:
        """Error with the calibrated vehicle over error with the sheet's, geometric mean.

        ``None`` without such runs.
        """
        ratios = [c.after / c.before for c in self.changes
                  if c.unseen == unseen and c.before > 0.0 and c.after > 0.0]
        return float(np.exp(np.mean(np.log(ratios)))) if ratios else None


@one_blas_thread
@determined
def calibrate(
    recordings: Sequence[Recording], *, holdout: Sequence[Recording] = (),
    vehicle: Vehicle | str = "international_9400i_trailmobile",
    settings: Settings | str = "default",
    step_s: float = _STEP_S, impose_speed: bool | None = None, workers: int | None = None,
    progress: Progress | None = None,
) -> Calibration:  # fmt: skip
    """Fit the sheet's numbers to ordinary driving.

    Args:
        recordings: runs of one truck in which nothing is missing.
        holdout: runs of it that are predicted only.
        vehicle: the sheet, by name, path or loaded.
        settings: the priors: name of a file in ``config/diagnosis``, or as loaded from one.
        step_s: integration step; ``workers``: threads; ``progress``: called with (stage, share).
        impose_speed: follow the recorded speed; None: only where throttle or brakes are missing.

    Returns:
        The calibration; :func:`write_calibrated_vehicle` makes a vehicle file of it.

    Raises:
        InputError: no recording, one given twice, one that cannot drive the model, or more than fit
            into memory.
    """
    if not recordings:
        raise InputError("no recording to calibrate on", expected="at least one recording")
    check_each_once({"fitted": recordings, "only predicted": holdout})
    recordings, holdout = names_apart(recordings, holdout)
    tell = progress or _silent
    loaded = load_vehicle(vehicle) if isinstance(vehicle, str) else vehicle
    packed, lockup = as_braked(pack(loaded), recordings)
    rules = load_settings(packed, settings) if isinstance(settings, str) else settings
    rules = replace(rules, nuisances=tuple(replace(n, step=_FINER * n.step)
                                           for n in rules.nuisances))  # fmt: skip
    tell("sensor gate", 0.0)
    found = sensor_gate(list(recordings), (), vehicle_geometry(loaded)).findings
    runs, unseen = ([correct(r, found) for r in group] for group in (recordings, holdout))
    quanta = seen_quanta([*recordings, *holdout])
    study = Study(
        tuple(prepare_run(r, "baseline", packed, rules, step_s=step_s, impose_speed=impose_speed,
                          quanta=quanta)
              for r in runs), (), packed, rules, workers or os.cpu_count() or 1)  # fmt: skip
    settle(study, progress=progress)
    amounts, spread, told = _posterior(study)
    place = np.array([n.of_the_place for n in rules.nuisances])
    truck = apply_amounts(packed, rules.nuisances, np.where(place, 0.0, amounts))
    tell("runs before and after", 0.5)
    sheet = _errors(packed, runs, unseen, impose_speed)
    share, changes = 0.0, _paired(sheet, sheet)
    for one in _SHARES:
        tried = apply_amounts(packed, rules.nuisances, np.where(place, 0.0, one * amounts))
        after = _paired(sheet, _errors(tried, runs, unseen, impose_speed))
        if _mean_log(c for c in after if not c.unseen) < 0.0:
            truck, share, changes = tried, one, after
            break
    return Calibration(
        loaded.name, tuple(r.name for r in recordings), tuple(r.name for r in holdout),
        _numbers(packed, rules.nuisances, amounts, spread, told, share), changes, found,
        truck if share else packed, _notes(study, amounts, share, lockup), share, lockup)


def write_calibrated_vehicle(
    path: Path, base: Vehicle | str, calibration: Calibration
) -> Vehicle:
    """Write the calibrated vehicle as a file that extends the sheet's.

    Args:
        path: file to write.
        base: the sheet that was calibrated.
        calibration: what was found.

    Returns:
        The vehicle, read back from the file.

    Raises:
        InputError: the file cannot be written.
    """
    given = pack(load_vehicle(base) if isinstance(base, str) else base)
    values = calibration.packed.differing(given)
    said: dict[str, list[str]] = {}
    for number in calibration.told:
        for name in number.values:
            said.setdefault(name, []).append(describe(number))
    runs = ", ".join(calibration.runs)
    sources = {name: f"calibrated on {runs}: {'; '.join(said.get(name, ['with another number']))}"
               for name in values}  # fmt: skip
    if calibration.lockup is not None:
        sources[MODE] = calibration.lockup.sentence
    words = "calibrated" if calibration.share else "not calibrated: the sheet was kept"
    return write_vehicle(path, base, values, sources, title=f"{calibration.vehicle}, {words}")


def describe(number: SheetNumber) -> str:
    """A number as a person reads it: change, interval, prior and its source."""
    factor, unit = (100.0, "%") if number.kind == "scale" else _shown_unit(number)
    low, high = (factor * end for end in number.ci90)
    words = number.name.replace("_", " ")
    ends = " (stopped at the end of its prior)" if number.at_prior_end else ""
    amount = f"{factor * number.change:+.3g} {unit}".rstrip()
    prior = f"{factor * number.prior_sigma:.3g} {unit}".rstrip()
    return (f"{words} {amount} (90 %: {low:+.3g} to {high:+.3g}; prior {prior}: "
            f"{number.source or 'not stated'}){ends}")


def _shown_unit(number: SheetNumber) -> tuple[float, str]:
    """Factor from SI and unit of a number that is added."""
    unit = unit_of(next(iter(number.values), ""))
    shown = {"rad": (float(np.degrees(1.0)), "deg"), "m": (1000.0, "mm"), "Pa": (1e-3, "kPa"),
             "s": (1e3, "ms"), "1/rad^2": (1.0, "1/rad²")}  # fmt: skip
    return shown.get(unit, (1.0, unit))


def _posterior(study: Study) -> tuple[Floats, Floats, NDArray[np.bool_]]:
    """Amounts of the sheet's numbers [prior sigmas from the sheet], their spread, which are told.

    A number is told where the runs hold more information on it than its prior. The others stay at
    the sheet and the told ones are fitted again.
    """
    n_sheet = len(study.settings.nuisances)
    everything = Projector.of(study.columns)
    spread = np.sqrt(np.diag(everything.covariance()))[:n_sheet]
    told: NDArray[np.bool_] = np.asarray(spread < np.sqrt(0.5))
    kept = [*np.flatnonzero(told).tolist(), *range(n_sheet, study.columns.shape[1])]
    part = Projector.of(study.columns, kept)
    bound = np.full(len(kept), np.inf)
    bound[: int(told.sum())] = FURTHEST
    found = part.amounts_within(study.residual(), -bound, bound)
    amounts = np.zeros(n_sheet)
    amounts[told] = found[: int(told.sum())]
    return amounts, spread, told


def _numbers(
    packed: Packed, sheet: Sequence[Nuisance], amounts: Floats, spread: Floats,
    told: NDArray[np.bool_], share: float,
) -> tuple[SheetNumber, ...]:  # fmt: skip
    """The numbers, moved a share of the way; their intervals reach to where the runs point.

    Where no share of the way predicts the runs better, they tell none of the numbers.
    """
    found = []
    for k, number in enumerate(sheet):
        asked, amount = float(amounts[k]), share * float(amounts[k])
        wide = NINETY * float(spread[k])
        low, high = min(asked - wide, amount), max(asked + wide, amount)
        found.append(SheetNumber(
            name=number.name, kind=number.kind, change=amount * number.sigma,
            ci90=(low * number.sigma, high * number.sigma), prior_sigma=number.sigma,
            source=number.source, values=dict(number.values(packed, amount * number.sigma)),
            told=bool(told[k]) and share > 0.0, of_the_place=number.of_the_place,
            at_prior_end=abs(amount) >= FURTHEST))  # fmt: skip
    return tuple(sorted(found, key=lambda n: -abs(n.change) / n.prior_sigma))


def _notes(study: Study, amounts: Floats, share: float, lockup: Lockup | None) -> tuple[str, ...]:
    """What a user must know of the result."""
    notes = [] if lockup is None else [lockup.sentence]
    if share == 0.0:
        tried = " or ".join(f"{one:.0%}" for one in _SHARES)
        notes.append(f"nothing was calibrated, the sheet was kept: moved {tried} of the way to "
                     "where linear sensitivities point, its numbers predict these runs worse")
    elif share < 1.0:
        notes.append(f"the numbers were moved {share:.0%} of the way to where linear sensitivities "
                     "point: further on, these runs are predicted worse")
    sheet = zip(study.settings.nuisances, amounts, strict=True)
    ends = [n.name.replace("_", " ") for n, amount in sheet
            if abs(amount) >= FURTHEST and not n.of_the_place]
    if ends:
        notes.append(f"{', '.join(ends)}: these runs ask for more than vehicles of one kind "
                     "differ; the sheet is of another vehicle, or physics is missing (diagnose)")
    return (*notes, *parting_notes(study.runs))


def _errors(
    truck: Packed, runs: Sequence[Recording], unseen: Sequence[Recording],
    impose_speed: bool | None,
) -> dict[tuple[str, str, bool], float]:  # fmt: skip
    """Rms error of every measured channel of every run, as ``compare`` finds it."""
    found = {}
    for group, is_unseen in ((runs, False), (unseen, True)):
        for run in group:
            for name, rms in rms_errors(run, truck, impose_speed=impose_speed).items():
                if name in run:
                    found[run.name, name, is_unseen] = rms
    return found


def _paired(
    before: Mapping[tuple[str, str, bool], float], after: Mapping[tuple[str, str, bool], float]
) -> tuple[ChannelChange, ...]:
    return tuple(ChannelChange(run, channel, unseen, rms, after[run, channel, unseen])
                 for (run, channel, unseen), rms in before.items()
                 if (run, channel, unseen) in after)  # fmt: skip


def _mean_log(changes: Iterable[ChannelChange]) -> float:
    ratios = [np.log(c.after / c.before) for c in changes if c.before > 0.0 and c.after > 0.0]
    return float(np.mean(ratios)) if ratios else 0.0


def _silent(stage: str, share: float) -> None:
    """Tells nobody."""
