"""A recording prepared for the diagnosis: driven, cut into bins, weighed.

Residuals are bin means of (measured - model) over the standard error that noise and the stated
difference between good models leave in a bin. A difference lasts for about ``correlation_s``, so
its share is widened by the number of bins it spans.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.algebra.color import Color
from truck_blowout_sim.diagnosis.case.leaning import Leaning, leaning_of
from truck_blowout_sim.diagnosis.case.sliding import Parting, partings_of
from truck_blowout_sim.diagnosis.case.trust import BRAKES_ON_PA
from truck_blowout_sim.diagnosis.case.widths import rms_around, swings, widths
from truck_blowout_sim.diagnosis.result.evidence import Role
from truck_blowout_sim.diagnosis.sensors import Noise, channel_noise, slow_noise
from truck_blowout_sim.diagnosis.settings import Settings
from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings import Recording
from truck_blowout_sim.simulation.course import Course
from truck_blowout_sim.simulation.drive import Drive, execute, names_of, run_drive
from truck_blowout_sim.simulation.plausible import diverged
from truck_blowout_sim.simulation.rates import check_delays
from truck_blowout_sim.simulation.replay import drive_from
from truck_blowout_sim.vehicle import Packed

Floats = NDArray[np.float64]
_BEST_INSTRUMENT = 0.1  # smallest noise believed, in units of the model's floor
_COARSE_ENOUGH = 0.4  # rms sigmas that the coarse step may have to be corrected by; 0.1 is usual
_BRAKES = slice(2, None)  # columns of a drive's inputs
_LOST = 1e4  # sigmas assigned to a simulation that broke down
EDGE_S = 0.5  # so close to either end of a run no event is tried


@dataclass(frozen=True, eq=False)
class Run:
    """One recording on bins.

    Attributes:
        recording, role, drive: where it comes from, how it is used, what drives the model.
        fine: the same drive on the fine step, from which ``correction`` comes.
        channels: names used, m of them; ``columns``: their places in the model's output.
        edges_s: bin edges, n + 1.
        measured, sigma: [n, m] bin means and their standard errors; NaN where not measured.
        noise: standard error from the instrument alone.
        correction: [n, m] what the fine step changes in the reference truck's bin means; added to
            those of every truck, which are simulated on the coarse step.
        color: of the residual in units of ``sigma``; what is whitened has it taken out.
        course, since_s: a driven truck from which those simulated differ only after an instant.
        leaning: accelerations that the recording has free of gravity.
        partings: while the recording and the model slide apart, nothing counts as measured.
    """

    recording: Recording
    role: Role
    drive: Drive
    channels: tuple[str, ...]
    columns: tuple[int, ...]
    edges_s: Floats
    measured: Floats
    sigma: Floats
    noise: Floats
    fine: Drive
    correction: Floats
    color: Color
    course: Course | None = None
    since_s: float = 0.0
    leaning: tuple[Leaning, ...] = ()
    partings: tuple[Parting, ...] = ()

    @property
    def middles_s(self) -> Floats:
        """[n] the middle of each bin."""
        return np.asarray(0.5 * (self.edges_s[1:] + self.edges_s[:-1]))

    @property
    def length_s(self) -> float:
        """From the first bin's beginning to the last one's end."""
        return float(self.edges_s[-1] - self.edges_s[0])

    @property
    def has_blowout(self) -> bool:
        """Whether a tire is blown on command."""
        return bool(self.recording.blowouts)

    @property
    def lost_s(self) -> float:
        """When the first tire is blown on command; infinite: none is."""
        return min((event.time_s for event in self.recording.blowouts), default=np.inf)

    @property
    def braked(self) -> NDArray[np.bool_]:
        """[steps, circuits] whether a brake is applied."""
        return np.asarray(self.drive.inputs[:, _BRAKES] > BRAKES_ON_PA)

    @property
    def has_brakes(self) -> bool:
        """Whether any brake was applied."""
        return bool(self.braked.any())

    def episodes(self, first: int, least_s: float) -> list[slice]:
        """Rows, counted from ``first``, of equal parts of the run that last so long at least.

        Two of them differ from the model as two runs do.
        """
        bins, channels = self.measured.shape
        ends = np.linspace(0, bins, max(int(self.length_s // least_s), 1) + 1).round().astype(int)
        return [slice(first + a * channels, first + b * channels)
                for a, b in zip(ends[:-1].tolist(), ends[1:].tolist(), strict=True)]

    def shows(self, applies: str) -> bool:
        """Whether an effect that needs ``applies`` (any, blowout, brakes) can be seen here."""
        return {"any": True, "": True, "blowout": self.has_blowout,
                "brakes": self.has_brakes}[applies]

    def simulated(self, truck: Packed) -> Floats:
        """[n, m] bin means of a truck over this run."""
        out = (run_drive(truck, self.drive) if self.course is None
               else self.course.left_at(truck, self.since_s))
        return self.bins_of(out) + self.correction

    def corrected(self, truck: Packed) -> Run:
        """This run, corrected for the coarse step at a reference truck.

        Where that would have to correct much, the coarse step is no use for this truck (a stiff
        rim, datasets that are swapped): everything is then simulated on the fine one.

        Raises:
            DivergedError: the truck leaves the range of the model on the fine step, too.
        """
        fine = execute(truck, self.fine)
        if fine.ending is not None and not fine.ending.rolled_over:
            raise diverged(truck, self.fine, fine.ending, self.recording.name)
        if self.fine.step_s == self.drive.step_s:
            return self
        change = self.bins_of(fine.out, self.fine) - self.bins_of(run_drive(truck, self.drive))
        if not np.sqrt(np.nanmean((change / self.sigma) ** 2)) < _COARSE_ENOUGH:
            return replace(self, drive=self.fine)
        return replace(self, correction=np.where(np.isfinite(change), change, 0.0))

    def shifted(self, whitened: Floats) -> Run:
        """This run, its model lowered by a whitened vector [n * m]."""
        return replace(self, correction=self.correction - self.plain(whitened))

    def plain(self, whitened: Floats) -> Floats:
        """[n, m] a whitened vector [n * m] in the channels' units, zero where not measured."""
        return np.nan_to_num(self.color.colored(whitened.reshape(self.sigma.shape)) * self.sigma)

    def bins_of(self, out: Floats, drive: Drive | None = None) -> Floats:
        """[n, m] bin means of a model output [rows, outputs] of ``drive``, else of the own."""
        rows = self._rows(out.shape[0], drive or self.drive)
        means = _means(out, self.columns, rows)
        for one in self.leaning:
            means[:, one.place] -= one.felt(_means(out, one.angles, rows))
        return means

    def _rows(self, n_rows: int, drive: Drive) -> NDArray[np.int64]:
        """Output row at which each bin begins, and where the last one ends."""
        period = drive.every * drive.step_s
        rows = np.round((self.edges_s - drive.initial.time_s) / period).astype(np.int64)
        return np.minimum(rows, n_rows)

    def weighed(self, model: Floats, settings: Settings) -> Run:
        """This run, its widths those of the motion that it and a model [n, m] both have.

        Its correction is still that for the coarse step.
        """
        swing = np.minimum(swings(model, settings), swings(self.measured, settings))
        sigma = widths(self.channels, self.noise, swing, settings,
                       rms_around(self.correction, settings))
        return replace(self, sigma=np.where(np.isfinite(self.sigma), sigma, np.nan))

    def counted(self, model: Floats, units: Sequence[str], least_s: float) -> tuple[Run, Floats]:
        """This run and a model [n, m] without what follows where a unit slides apart from it.

        Enough is left to try an event in. ``least_s``: see :func:`partings_of`.
        """
        partings = partings_of(self.edges_s, self.channels, self.measured, model, units, least_s)
        if not partings:
            return self, model
        bins, last = self.measured.shape[0], partings[-1]
        if np.isinf(last.until_s):
            bins = max(int(np.searchsorted(self.edges_s, last.at_s)),
                       _fewest_bins(float(self.edges_s[1] - self.edges_s[0])))
        cut = {name: getattr(self, name)[:bins]
               for name in ("measured", "sigma", "noise", "correction")}
        middles = self.middles_s[:bins]
        for one in partings[:-1] if np.isinf(last.until_s) else partings:
            during = (middles > one.at_s) & (middles < one.until_s)
            cut |= {name: np.where(during[:, None], np.nan, cut[name])
                    for name in ("measured", "sigma")}
        return (replace(self, edges_s=self.edges_s[:bins + 1], partings=partings, **cut),
                model[:bins])

    def residual(self, model: Floats) -> Floats:
        """[n * m] whitened measured - model, zero where not measured, bounded where it broke."""
        z = (self.measured - model) / self.sigma
        broken = ~np.isfinite(model) & np.isfinite(self.measured)
        bounded = np.clip(np.where(broken, _LOST, np.where(np.isnan(z), 0.0, z)), -_LOST, _LOST)
        return self.color.whitened(bounded).ravel()

    def change(self, now: Floats, base: Floats) -> Floats:
        """[n * m] whitened now - base, zero where not measured."""
        z = (now - base) / self.sigma
        bounded = np.clip(np.where(np.isfinite(z), z, 0.0), -_LOST, _LOST)
        return self.color.whitened(bounded).ravel()


def _means(out: Floats, columns: Sequence[int], rows: NDArray[np.int64]) -> Floats:
    """[n, m] means of some columns of an output between the rows at which bins begin."""
    sums = np.add.reduceat(out[:, columns], rows[:-1], axis=0)[:len(rows) - 1]
    counts = np.diff(np.append(rows[:-1], rows[-1]))[:, None]
    sums[-1] = out[rows[-2]:rows[-1], columns].sum(axis=0)
    return np.asarray(sums / counts)


def prepare_run(recording: Recording, role: Role, packed: Packed, settings: Settings, *,
                step_s: float, impose_speed: bool | None = None,
                quanta: Mapping[str, float] | None = None) -> Run:
    """Cut a recording into bins and weigh its channels.

    ``quanta``: see :func:`truck_blowout_sim.diagnosis.sensors.seen_quanta`; ``impose_speed``: see
    :func:`truck_blowout_sim.simulation.replay.drive_from`. ``step_s`` is the
    fine step; what is tried is simulated on the settings' coarse one, corrected by the difference.

    Raises:
        InputError: the recording cannot drive the model, or is too short to try any event in it.
    """
    check_delays(packed, step_s)
    fine, drive = (drive_from(recording, packed.vehicle, step_s=step, impose_speed=impose_speed)
                   for step in (step_s, max(step_s, settings.trial_step_s)))
    names = names_of(packed.vehicle)
    noise = {**channel_noise(recording, quanta), **slow_noise(recording)}
    channels = tuple(n for n in names if n in recording and n in noise
                     and settings.rule(n) and not _redundant(n, drive))
    edges = _edges(recording, drive, settings)
    if not channels:
        raise InputError("no channel that can be diagnosed", file=recording.name,
                         expected="a speed, a rate, an angle or an acceleration of the vehicle")
    parts = [_channel_bins(recording, n, noise[n], edges, settings) for n in channels]
    measured, plain = (np.stack([p[k] for p in parts], axis=1) for k in range(2))
    sigma = widths(channels, plain, swings(measured, settings), settings)
    # a bin without samples must not count as one in which nothing changed
    sigma = np.where(np.isfinite(measured), sigma, np.nan)
    return Run(recording, role, drive, channels, tuple(names.index(n) for n in channels), edges,
               measured, sigma, plain, fine, np.zeros(measured.shape),
               Color.white(len(channels)), leaning=leaning_of(recording, channels, names))


def _edges(recording: Recording, drive: Drive, settings: Settings) -> Floats:
    """Edges of the bins; refuses a run in which no instant is far enough from both ends."""
    start, end = drive.initial.time_s + settings.skip_s, float(drive.times_s[-1])
    n_bins, least = int((end - start) / settings.bin_s), _fewest_bins(settings.bin_s)
    if n_bins < least:
        least_s = settings.skip_s + least * settings.bin_s
        raise InputError(f"lasts {recording.end_s - recording.start_s:.3g} s, which is too short "
                         "for a diagnosis", file=recording.name,
                         expected=f"at least {least_s:.3g} s")
    return np.asarray(start + np.arange(n_bins + 1) * settings.bin_s, dtype=np.float64)


def _fewest_bins(bin_s: float) -> int:
    """Bins that a run needs so that an event can be tried in it."""
    return round(2.0 * EDGE_S / bin_s) + 1


def _redundant(name: str, drive: Drive) -> bool:
    """An imposed speed says nothing about what drives or brakes."""
    return drive.speed_imposed and (name.endswith(("_vx_mps", "_ax_mps2"))
                                    or name.startswith("hub_speed_"))


def _channel_bins(recording: Recording, name: str, noise: Noise, edges: Floats,
                  settings: Settings) -> tuple[Floats, Floats]:
    """Bin means, NaN where there is no sample, and the standard errors of the instrument."""
    series, rule = recording[name], settings.rule(name)
    assert rule is not None
    mean, counts = bin_means(series.time_s, series.value, edges)
    single = noise.at(np.nan_to_num(mean))
    independent = np.clip(noise.effective_rate_hz * settings.bin_s, 1.0, np.maximum(counts, 1.0))
    plain = np.maximum(single / np.sqrt(independent), noise.quantum / 6.0)
    # a gauge that reads nothing, or a computed series, seems noiseless: none is that good
    return mean, np.maximum(plain, _BEST_INSTRUMENT * rule.floor)


def bin_means(time_s: Floats, values: Floats, edges_s: Floats) -> tuple[Floats, Floats]:
    """Mean of the samples in each bin, NaN where there is none, and how many there are."""
    place = np.searchsorted(edges_s, time_s + 1e-9, side="right") - 1
    inside = (place >= 0) & (place < edges_s.size - 1)
    counts = np.bincount(place[inside], minlength=edges_s.size - 1).astype(np.float64)
    sums = np.bincount(place[inside], values[inside], minlength=edges_s.size - 1)
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.where(counts > 0, sums / counts, np.nan), counts


def parting_notes(runs: Iterable[Run]) -> list[str]:
    """What a reader should know of runs that do not count as a whole."""
    return [f"{run.recording.name}: from {one.at_s:.1f} s "
            f"{'on' if np.isinf(one.until_s) else f'to {one.until_s:.1f} s'} the {one.unit} slides "
            "and the model does not, or the other way round; this does not count"
            for run in runs for one in run.partings]
