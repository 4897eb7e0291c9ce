"""A case: its recordings, what is normal about its instruments, and what may be wrong."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.sensors.catalogue import Imperfection, candidates, imperfections
from truck_blowout_sim.diagnosis.sensors.covariance import Covariances
from truck_blowout_sim.diagnosis.sensors.distortions import Distortion
from truck_blowout_sim.diagnosis.sensors.geometry import Geometry, stated_geometry
from truck_blowout_sim.diagnosis.sensors.hubs import hub_identity, rolling_radii
from truck_blowout_sim.diagnosis.sensors.identities import (
    Identity,
    articulation_identities,
    body_identities,
    hitch_identities,
)
from truck_blowout_sim.diagnosis.sensors.noise import (
    Noise,
    believable,
    channel_noise,
    excess_noise,
    seen_quanta,
)
from truck_blowout_sim.diagnosis.sensors.path import (
    distance_name,
    path_identities,
    with_distance,
)
from truck_blowout_sim.diagnosis.sensors.signals import Signals, read_signals
from truck_blowout_sim.diagnosis.sensors.towed import hitch_force, with_reckoned
from truck_blowout_sim.recordings import Recording

FloatArray = NDArray[np.float64]

# Gravity through a tilt that was not recorded: 0.1 m/s2, slow, so worth more per bump.
_UNKNOWN_TILT_MPS2 = 0.3


@dataclass(frozen=True)
class Hypothesis:
    """A candidate fault and where it is at work.

    Attributes:
        distortion: what goes wrong.
        everywhere: in the baseline recordings too, else only in the others.
    """

    distortion: Distortion
    everywhere: bool


@dataclass(frozen=True)
class Applied:
    """A hypothesis with amounts."""

    hypothesis: Hypothesis
    amounts: tuple[float, ...]


def with_amounts(
    hypotheses: Sequence[Hypothesis], amounts: Sequence[Iterable[float]]
) -> tuple[Applied, ...]:
    """Each hypothesis with its amounts."""
    return tuple(Applied(h, tuple(a)) for h, a in zip(hypotheses, amounts, strict=True))


@dataclass(frozen=True)
class Case:
    """What does not change while faults are sought.

    Attributes:
        signals: every recording as measured, baseline last.
        is_baseline: flag of each.
        noise: channel noise of each.
        geometry: lengths.
        radii: rolling radius by hub-speed channel.
        usual: normal imperfections.
        hypotheses: candidate faults.
        covariances: memory of each recording's noise covariance, filled as needed.
    """

    signals: tuple[Signals, ...]
    is_baseline: tuple[bool, ...]
    noise: tuple[Mapping[str, Noise], ...]
    geometry: Geometry
    radii: Mapping[str, float]
    usual: tuple[Imperfection, ...]
    hypotheses: tuple[Hypothesis, ...]
    covariances: tuple[Covariances, ...]

    @property
    def prior_precision(self) -> FloatArray:
        """1/sigma² of the columns of the normal imperfections."""
        return np.array([1.0 / u**2 for i in self.usual for u in i.usual])

    @property
    def faults(self) -> tuple[Distortion, ...]:
        """Distortions of the hypotheses, each once."""
        return tuple(dict.fromkeys(h.distortion for h in self.hypotheses))

    def columns(self, faults: Sequence[Distortion]) -> list[tuple[Distortion, int]]:
        """Unknowns: parameters of the imperfections first, then of the given faults."""
        usual = [i.distortion for i in self.usual]
        return [(d, k) for d in [*usual, *faults] for k in range(len(d.parameters))]


def make_case(
    recordings: Sequence[Recording], baseline: Sequence[Recording], geometry: Geometry | None
) -> Case:
    """Read the recordings and list what to ask."""
    everything = [*recordings, *baseline]
    quanta = seen_quanta(everything)
    signals = tuple(
        with_distance(with_reckoned(read_signals(recording))) for recording in everything
    )
    noise = tuple(
        _with_distance_noise(believable(channel_noise(r.only_channels(list(s.values)), quanta)))
        for r, s in zip(everything, signals, strict=True))
    lengths = stated_geometry(everything, geometry)
    reference = signals[len(recordings) :] if baseline else signals
    radii = rolling_radii(reference, lengths)
    present = {name for s in signals for name in s.values}
    found = candidates(present)
    hypotheses = [Hypothesis(d, everywhere=not baseline) for d in found]
    if baseline:
        hypotheses += [Hypothesis(d, everywhere=True) for d in found]
    return Case(
        signals=signals,
        is_baseline=(False,) * len(recordings) + (True,) * len(baseline),
        noise=noise,
        geometry=lengths,
        radii=radii,
        usual=imperfections(
            present,
            excess_noise(noise),
            radius_known=bool(baseline),
            gravity_read=any(any(s.gravity.values()) for s in signals),
        ),
        hypotheses=tuple(hypotheses),
        covariances=tuple({} for _ in everything),
    )


def _with_distance_noise(noise: Mapping[str, Noise]) -> Mapping[str, Noise]:
    """The reckoned distance is as noisy as the positions that it is made of."""
    return {**noise, **{distance_name(unit): noise[f"{unit}_x_m"]
                        for unit in ("tractor", "trailer") if f"{unit}_x_m" in noise}}  # fmt: skip


def asked(case: Case, signals: Signals) -> tuple[Identity, ...]:
    """Identities that a recording has the channels for."""
    found = [i for unit in ("tractor", "trailer") for i in body_identities(unit)]
    found += hitch_identities(case.geometry)
    found += hitch_force(signals, case.geometry)
    found += articulation_identities()
    found += path_identities(signals)
    kept = [i for i in found if i.available(signals)]
    for unit in ("tractor", "trailer"):
        hub = hub_identity(signals, unit, case.radii, case.geometry)
        if hub is not None:
            kept.append(hub)
    return tuple(_tilt_allowed(i, signals) for i in kept)


def _tilt_allowed(identity: Identity, signals: Signals) -> Identity:
    """Allow for gravity where an accelerometer's tilt was not recorded."""
    for word, angle in (("lateral", "roll"), ("longitudinal", "pitch")):
        unit = identity.name.split()[0]
        if (
            signals.gravity.get(unit)
            and f"{word} acceleration" in identity.name
            and f"{unit}_{angle}_rad" not in signals
        ):
            return replace(identity, model_sigma=_UNKNOWN_TILT_MPS2)
    return identity


def undone(signals: Signals, applied: Sequence[Applied], *, baseline: bool) -> Signals:
    """Signals with found faults taken out, delays first."""
    active = [a for a in applied if a.hypothesis.everywhere or not baseline]
    late = [a for a in active if a.hypothesis.distortion.parameters[0][0] == "delay"]
    other = [a for a in active if a not in late]
    for item in [*late, *other]:
        distortion = item.hypothesis.distortion
        smooth = signals.smooth()
        values = {}
        for channel in distortion.channels:
            if channel not in signals:
                continue
            measured = signals[channel]
            time_s, value = distortion.undo(
                item.amounts, channel, signals.time_s, measured, smooth.__getitem__
            )
            if item in late:
                value = np.interp(signals.time_s, time_s, value, left=np.nan, right=np.nan)
            values[channel] = value
        signals = signals.with_values(values)
    return signals
