"""What stands behind a diagnosis: maps, overlays, candidates, forces, assumptions.

A page draws it. Whatever was not computed stays empty, and its part of the page says so.

Validated with: test/report/test_diagnosis_page.py.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.result.parts import Place
from truck_blowout_sim.diagnosis.sensors import SensorFinding

FloatArray = NDArray[np.float64]
# prior sigmas from the sheet beyond which a number is told: just below the three at which
# predictions stop it, so that what is stopped is told
FAR = 2.9
Role = Literal["train", "holdout", "baseline"]


@dataclass(frozen=True)
class Candidate:
    """One explanation that was tried.

    Attributes:
        name, where: what and where.
        delta_chi2: fall of the weighted sum of squares in training that it buys.
        p_value: chance of such a fall if nothing were missing, ``None`` if not calibrated.
        accepted: whether it became an effect.
        aliased: whether it fits as well as one that did.
        reason: why it was kept or dropped, in words; ``rule`` that decided, with the ``value`` that
            it had and the ``limit`` that was asked.
        amount: its main parameter in words, such as ``0.35 (0.31 to 0.39)``.
    """

    name: str
    where: Place
    delta_chi2: float
    p_value: float | None = None
    accepted: bool = False
    aliased: bool = False
    reason: str = ""
    rule: str = ""
    value: float = 0.0
    limit: float = 0.0
    amount: str = ""


@dataclass(frozen=True)
class Showing:
    """The smallest amounts of a cause that these recordings would show.

    Attributes:
        name, where: what and where.
        parameter, unit: which number of it, in SI.
        below, above: to either side of what a vehicle without it has; ``None`` where no amount up
            to the physical end would be named.
    """

    name: str
    where: Place
    parameter: str
    unit: str
    below: float | None
    above: float | None


@dataclass(frozen=True, eq=False)
class ChannelTimeMap:
    """Mismatch of each channel in each stretch of time, in sigma; NaN where not measured.

    Attributes:
        recording: its name.
        role: how it was used.
        time_s: edges of the stretches, n + 1.
        channels: m names.
        before: m x n signed mean residual over its standard error, model as given.
        after: the same with the diagnosed model; ``None`` if there is none.
    """

    recording: str
    role: Role
    time_s: FloatArray
    channels: tuple[str, ...]
    before: FloatArray
    after: FloatArray | None = None

    def __post_init__(self) -> None:
        shape = (len(self.channels), self.time_s.size - 1)
        for grid in (self.before, self.after):
            if grid is not None and grid.shape != shape:
                raise ValueError(f"map of {self.recording} is {grid.shape}, expected {shape}")


@dataclass(frozen=True, eq=False)
class Overlay:
    """One channel of one recording: measured, model as given, model as diagnosed; SI."""

    recording: str
    role: Role
    channel: str
    time_s: FloatArray
    measured: FloatArray
    before: FloatArray
    after: FloatArray | None = None
    noise: float | None = None


@dataclass(frozen=True, eq=False)
class ForceHistory:
    """Wrench missing on one body over time, with 1 sigma of each component."""

    recording: str
    body: str
    time_s: FloatArray
    fx_n: FloatArray
    fy_n: FloatArray
    mz_nm: FloatArray
    fx_sigma_n: FloatArray
    fy_sigma_n: FloatArray
    mz_sigma_nm: FloatArray


@dataclass(frozen=True, eq=False)
class BeatScores:
    """How clearly something beats at each distance or pace that was tried.

    Attributes:
        kind: ``turning``, ``steady`` or ``swinging``.
        every: distance [m], or of a steady pace time [s], from one beat to the next.
        score: standard errors above what chance gives; from ``least`` on it counts.
    """

    kind: str
    every: FloatArray
    score: FloatArray
    least: float


@dataclass(frozen=True)
class Calibrated:
    """A number of the spec sheet as the recordings would have it.

    Attributes:
        name: packed name or words, such as ``body.trailer.mass_kg``.
        unit: SI unit.
        prior, prior_sigma: what the sheet says and how far a truck of its kind strays.
        value, sigma: estimate and its standard error.
        relative: whether these are shares of what the sheet says.
    """

    name: str
    unit: str
    prior: float
    prior_sigma: float
    value: float
    sigma: float
    relative: bool = False

    @property
    def pull(self) -> float:
        """Distance from the sheet in prior sigmas."""
        return (self.value - self.prior) / self.prior_sigma


@dataclass(frozen=True)
class Evidence:
    """Everything a reader needs to check the answer.

    Attributes:
        vehicle: name of the vehicle file that was diagnosed.
        recordings: (name, role) of each.
        candidates: ranked, best first.
        would_show: where nothing was named, what would have been: see its class.
        maps, overlays, forces, beats: see their classes.
        about: channels that the answer's sentence names, beside those of named effects.
        calibrated: spec-sheet numbers that were estimated, whatever came out.
        equations: what the diagnosed model adds, one line each.
        assumptions: everything that was taken for granted, one sentence each.
        missing_channels: (channel, what it would have told apart).
        notes: what happened on the way that a reader should know.
        sources: (packed name, where its value comes from) of the diagnosed vehicle.
        findings: faults of instruments, as the sensor gate found them; they can be taken out.
        blowouts: (recording, instant, tires) of each tire that was blown on command.
        facts: other figures by name, as text (version, run time, number of simulations).
    """

    vehicle: str = ""
    recordings: tuple[tuple[str, Role], ...] = ()
    candidates: tuple[Candidate, ...] = ()
    would_show: tuple[Showing, ...] = ()
    maps: tuple[ChannelTimeMap, ...] = ()
    overlays: tuple[Overlay, ...] = ()
    about: tuple[str, ...] = ()
    forces: tuple[ForceHistory, ...] = ()
    beats: BeatScores | None = None
    calibrated: tuple[Calibrated, ...] = ()
    equations: tuple[str, ...] = ()
    assumptions: tuple[str, ...] = ()
    missing_channels: tuple[tuple[str, str], ...] = ()
    notes: tuple[str, ...] = ()
    facts: tuple[tuple[str, str], ...] = ()
    blowouts: tuple[tuple[str, float, str], ...] = ()
    sources: tuple[tuple[str, str], ...] = ()
    findings: tuple[SensorFinding, ...] = ()
