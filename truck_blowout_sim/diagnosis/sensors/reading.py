"""One recording read in another way: what the kinematic identities gain by it.

References: likelihood ratio of Gaussian residuals with their variance estimated (profile
likelihood); the number of independent residuals from their long-run variance (Bartlett window).
Known limits: residuals of different identities count as independent.
Validated with: test/diagnosis/test_sensors_conventions.py.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.sensors.distortions import Convention, GravityConvention
from truck_blowout_sim.diagnosis.sensors.geometry import Geometry
from truck_blowout_sim.diagnosis.sensors.hubs import axle_identities
from truck_blowout_sim.diagnosis.sensors.identities import (
    Identity,
    articulation_identities,
    body_identities,
    channel_names,
    hitch_identities,
)
from truck_blowout_sim.diagnosis.sensors.signals import WHEEL, Signals, smoothed
from truck_blowout_sim.diagnosis.sensors.windows import Windows, make_windows
from truck_blowout_sim.recordings.channels import UNITS
from truck_blowout_sim.recordings.gravity import AT_REST_MPS2

FloatArray = NDArray[np.float64]

_TINY = 1e-12  # of a residual's variance: that of a computed log may vanish
_LONGEST_S = 2.0  # of the correlation of a residual
_OVERLAP_S = 0.5  # judgement: bumps of 0.4 s share samples, so at most two a second count
_FEWEST = 10  # bumps, a second of them; judgement
_STEER_SMOOTH_S = 0.2  # judgement: drops noise, keeps what a truck follows; as for the wheel's zero
_STEER_LEAST_S = 3.0  # judgement: some times what a truck takes to answer its hand wheel
_STEER_EVERY_S = 0.1  # as far apart as bumps are
_MOST_ALIKE = 0.99  # judgement: noise of both instruments bounds what a correlation can promise
_DRIVES_MPS = 5.0  # no truck reverses faster
_BACKWARD = 20.0  # log odds against one that does, over a whole recording
_UPRIGHT = 20.0  # the same against a vertical accelerometer that is half a gravity off
_CONTRARY = 4.5  # log likelihood by which identities may speak against what that one says


@dataclass(frozen=True)
class Reading:
    """One recording with what its identities leave as it stands.

    ``mounted``: [windows, k] what errors of mounting add to any of them.
    """

    signals: Signals
    identities: tuple[Identity, ...]
    windows: Windows
    left: dict[str, FloatArray]
    mounted: FloatArray

    @classmethod
    def of(cls, signals: Signals, geometry: Geometry) -> Reading:
        """Every identity that the recording has the channels for."""
        asked = [i for unit in ("tractor", "trailer") for i in body_identities(unit)]
        asked += [*hitch_identities(geometry), *articulation_identities(),
                  *axle_identities(signals, geometry)]
        kept = tuple(i for i in asked if i.available(signals))
        windows = make_windows(signals.period_s)
        left = {i.name: i.under(windows, signals) for i in kept}
        return cls(signals, kept, windows, left, _mounted(signals, windows))

    def read_as(self, convention: Convention) -> Reading:
        """The log under another reading."""
        signals = convention.read(self.signals)
        touched = self._touched(convention)
        left = {i.name: i.under(self.windows, signals) if i in touched else self.left[i.name]
                for i in self.identities}  # fmt: skip
        return replace(self, signals=signals, left=left)

    def _touched(self, convention: Convention) -> list[Identity]:
        if isinstance(convention, GravityConvention):
            return [i for i in self.identities if "acceleration" in i.name]
        return [i for i in self.identities if set(i.channels) & set(convention.channels)]

    def log_ratio(self, convention: Convention, of: str = "") -> float:
        """Log likelihood of the log so read over that of the log as it stands.

        ``of``: a word in the names of the identities that are asked alone.
        """
        signals = convention.read(self.signals)
        total = sum(self._gain(i, signals) for i in self._touched(convention) if of in i.name)
        # a vertical accelerometer alone may be corrected otherwise than those along the road
        if isinstance(convention, GravityConvention) and total > -_CONTRARY:
            total += _upright(signals) - _upright(self.signals)
        return total + _steered(signals) - _steered(self.signals) + (
            _forward(signals) - _forward(self.signals))

    def gain_with(self, channel: str, without: str, convention: Convention) -> float:
        """The same by the identities that read one channel and not another."""
        signals = convention.read(self.signals)
        return sum(self._gain(i, signals) for i in self._touched(convention)
                   if channel in i.channels and without not in i.channels)  # fmt: skip

    def share_explained(self, convention: Convention) -> FloatArray:
        """Products of what the log as it stands leaves with what the other reading changes.

        With the change's own squares; both relative to what is left, over all identities concerned.
        """
        signals, total = convention.read(self.signals), np.zeros(2)
        for i in self._touched(convention):
            before = self.left[i.name]
            found = _unmounted(before, i.under(self.windows, signals), self.mounted)
            if found is not None:
                old, new = found
                moved = old - new
                total += np.array([old @ moved, moved @ moved]) / (np.var(old) + _TINY)
        return total

    def concerned(self, convention: Convention) -> set[str]:
        """Recorded channels of all identities that another reading changes."""
        return {c for i in self._touched(convention) for c in i.channels if c in self.signals}

    def late_gain(self, channel: str, delay_s: float, convention: Convention) -> float:
        """Log likelihood ratio with a channel read that much earlier.

        Of the identities that the other reading changes.
        """
        step = round(delay_s / self.signals.period_s)
        if step == 0:
            return 0.0
        early = np.concatenate([self.signals[channel][step:], np.full(step, np.nan)])
        signals = self.signals.with_values({channel: early})
        return sum(self._gain(i, signals) for i in self._touched(convention)
                   if channel in i.channels)  # fmt: skip

    def gain_of(self, signals: Signals) -> float:
        """The same for other signals, by the identities of accelerations."""
        return sum(self._gain(i, signals) for i in self.identities if "acceleration" in i.name)

    def _gain(self, identity: Identity, signals: Signals) -> float:
        after = identity.under(self.windows, signals)
        return _gain(self.left[identity.name], after, self.mounted, self.windows)


def _mounted(signals: Signals, windows: Windows) -> FloatArray:
    """A constant, and the forward speed: an angle that is off by one adds it to a side speed."""
    speed = channel_names("tractor")["vx"]
    some = [windows.mean(signals[speed])] if speed in signals else []
    constant = np.ones_like(windows.mean(signals.time_s))
    return np.stack([constant, *some], axis=1)


def _gain(before: FloatArray, after: FloatArray, mounted: FloatArray, windows: Windows) -> float:
    """Log likelihood ratio of two residuals, each with its own variance.

    Without what errors of mounting add to them, which says nothing of a sign.
    """
    found = _unmounted(before, after, mounted)
    if found is None:
        return 0.0
    old, new = found
    bump_s = windows.step * windows.period_s
    count = min(_independent(old, bump_s), _independent(new, bump_s))
    ratio = (float(np.var(old)) + _TINY) / (float(np.var(new)) + _TINY)
    return 0.5 * count * float(np.log(ratio))


def _unmounted(before: FloatArray, after: FloatArray, mounted: FloatArray
               ) -> tuple[FloatArray, FloatArray] | None:
    """Both where they are known, without what errors of mounting add; None if that is too short."""
    both = np.isfinite(before) & np.isfinite(after) & np.isfinite(mounted).all(axis=1)
    if both.sum() < _FEWEST:
        return None
    basis, _ = np.linalg.qr(mounted[both])
    old, new = (v[both] - basis @ (basis.T @ v[both]) for v in (before, after))
    return old, new


def _independent(values: FloatArray, spacing_s: float) -> float:
    """Number of independent values, by the long-run variance over two seconds."""
    moved = values - values.mean()
    power = float(moved @ moved)
    if power <= 0.0:
        return float(values.size)
    lags = min(max(round(_LONGEST_S / spacing_s), 1), values.size - 1)
    weights = 1.0 - np.arange(1, lags + 1) / (lags + 1.0)
    shared = np.array([float(moved[k:] @ moved[:-k]) for k in range(1, lags + 1)]) / power
    longest = max(1.0 + 2.0 * float(weights @ shared), _OVERLAP_S / spacing_s)
    return float(values.size / longest)


def _steered(signals: Signals) -> float:
    """Log likelihood of the yaw rate given that the truck turns where the hand wheel points."""
    rate = channel_names("tractor")["r"]
    if WHEEL not in signals or rate not in signals:
        return 0.0
    width = _STEER_SMOOTH_S / signals.period_s
    wheel, turning = smoothed(signals[WHEEL], width), smoothed(signals[rate], width)
    first = min(signals.blown_since_s.values(), default=np.inf)
    used = np.isfinite(wheel) & np.isfinite(turning) & (signals.time_s < first)
    if used.sum() * signals.period_s < _STEER_LEAST_S:
        return 0.0
    a, b = wheel[used] - wheel[used].mean(), turning[used] - turning[used].mean()
    size = float(np.sqrt((a @ a) * (b @ b)))
    alike = float(a @ b) / size if size > 0.0 else 0.0
    every = max(1, round(_STEER_EVERY_S / signals.period_s))
    count = _independent(b[::every], every * signals.period_s)
    return -0.5 * count * float(np.log1p(-min(alike, _MOST_ALIKE) ** 2)) if alike > 0.0 else 0.0


def _forward(signals: Signals) -> float:
    """Log odds against a truck that reverses fast."""
    return sum(-_BACKWARD for unit in ("tractor", "trailer")
               for speed in (channel_names(unit)["vx"],) if speed in signals
               and float(np.nan_to_num(np.nanmedian(signals[speed]))) < -_DRIVES_MPS)  # fmt: skip


def _upright(signals: Signals) -> float:
    """Log odds against a vertical accelerometer that reads gravity, or does not, unlike said.

    The median of a run is what it reads on a level road, whatever its mounting and calibration:
    one gravity, or nothing.
    """
    return sum(-_UPRIGHT for unit in UNITS
               for up in (channel_names(unit)["az"],) if up in signals
               and abs(float(np.nan_to_num(np.nanmedian(signals[up])))
                       - signals.gravity[unit] * AT_REST_MPS2) > 0.5 * AT_REST_MPS2)
