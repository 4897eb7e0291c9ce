"""What the sensor gate answers with.

Validated with: test/diagnosis/test_sensors_gate.py.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.algebra.quantiles import NINETY
from truck_blowout_sim.diagnosis.sensors.distortions import Distortion

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class Amount:
    """One parameter: value, SI unit, 90 % interval."""

    value: float
    unit: str
    ci90: tuple[float, float]

    @classmethod
    def about(cls, value: float, unit: str, sigma: float) -> Amount:
        """A value with its standard error."""
        half = NINETY * sigma
        return cls(value, unit, (value - half, value + half))


@dataclass(frozen=True)
class SensorFinding:
    """One instrument that is at fault.

    Attributes:
        name: canonical name of the effect.
        body: ``tractor``, ``trailer`` or empty.
        instrument: in words.
        channels: those it spoils.
        parameters: by name.
        delta_chi2: rise of the weighted sum of squares without it.
        p_value: chance of such a rise anywhere among the candidates if nothing were wrong.
        aliases: names that these recordings cannot tell apart, best first, its own first.
        in_baseline: whether the baseline recordings have it too.
        sentence: for a person.
        equation: measured against true.
        next_test: the run that would decide or confirm.
        distortion: how it acts, to take it out.
    """

    name: str
    body: str
    instrument: str
    channels: tuple[str, ...]
    parameters: Mapping[str, Amount]
    delta_chi2: float
    p_value: float
    aliases: tuple[str, ...]
    in_baseline: bool
    sentence: str
    equation: str
    next_test: str
    distortion: Distortion

    @property
    def amounts(self) -> tuple[float, ...]:
        """Values in the order of the distortion's parameters."""
        return tuple(
            self.parameters[name].value if name in self.parameters else 0.0
            for name, _ in self.distortion.parameters
        )


@dataclass(frozen=True)
class IdentityResidual:
    """How well one identity holds in one recording.

    Attributes:
        identity: its name.
        recording: the recording's name.
        equation: as a person reads it.
        unit: of the residual.
        count: number of bumps (0.4 s means).
        sigma: what channel noise explains of a single bump.
        rms: before anything is taken out.
        rms_sigma: the same over ``sigma``, about 1 where the identity holds.
        rms_sigma_after: with found faults and normal mounting errors taken out.
        mean: before.
        time_s: middle of each one-second stretch.
        stretch_sigma: mean of each stretch over its own sigma, before.
        stretch_sigma_after: after.
    """

    identity: str
    recording: str
    equation: str
    unit: str
    count: int
    sigma: float
    rms: float
    rms_sigma: float
    rms_sigma_after: float
    mean: float
    time_s: FloatArray
    stretch_sigma: FloatArray
    stretch_sigma_after: FloatArray


@dataclass(frozen=True)
class GateResult:
    """Everything the sensor gate has to say.

    Attributes:
        findings: faulty instruments, strongest evidence first; empty if all is well.
        identities: residuals of every identity in every recording.
        broken: names of identities that no listed fault repairs.
        untestable: channels that no identity reads, so nothing can be said of them.
        steering: hand-wheel zero, ``None`` where it cannot be asked.
        inflation: factor on the noise of each identity that was needed.
        chi2: weighted sum of squares left, of ``rows`` rows.
        rows: number of rows.
        mounting: estimated normal mounting errors, "what (parameter)" -> amount.
        notes: what was assumed or could not be asked.
    """

    findings: tuple[SensorFinding, ...]
    identities: tuple[IdentityResidual, ...]
    broken: tuple[str, ...]
    untestable: tuple[str, ...]
    steering: SteeringZero | None
    inflation: Mapping[str, float]
    chi2: float
    rows: int
    mounting: Mapping[str, Amount]
    notes: tuple[str, ...]

    @property
    def clean(self) -> bool:
        """Whether no instrument is at fault."""
        return not self.findings


@dataclass(frozen=True)
class SteeringZero:
    """Hand-wheel angle at which the truck drives straight.

    Attributes:
        offset_rad: mean over the recordings (at the hand wheel).
        sigma_rad: its standard error.
        baseline_rad: the same over the baseline, ``None`` without one.
        baseline_sigma_rad: its standard error.
        by_recording: offset of each recording that could be asked.
    """

    offset_rad: float
    sigma_rad: float
    baseline_rad: float | None
    baseline_sigma_rad: float | None
    by_recording: Mapping[str, float]
