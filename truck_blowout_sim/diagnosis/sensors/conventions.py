"""Are signs, axes and the treatment of gravity as they are said to be? Asked before anything else.

A channel that is positive the other way, two channels that are exchanged, and accelerations that
are said to be free of gravity and are not, leave no amount to estimate: a log has them or not.
Each such reading of the log is tried, and the one under which the kinematic identities leave less
by a clear likelihood ratio is taken; then the next is sought in the log so read. Two relations
join the identities, which a mirrored instrument satisfies: a truck turns to the side to which its
hand wheel is turned, and it drives forward.

References: likelihood ratio of Gaussian residuals with their variance estimated (profile
likelihood); the number of independent residuals from their long-run variance (Bartlett window).
Known limits: the instruments of one truck all mirrored, hand wheel included, are consistent.
Validated with: test/diagnosis/test_sensors_conventions.py.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.sensors.distortions import (
    Convention,
    GravityConvention,
    Sign,
    Swap,
)
from truck_blowout_sim.diagnosis.sensors.geometry import Geometry
from truck_blowout_sim.diagnosis.sensors.identities import (
    Identity,
    articulation_identities,
    body_identities,
    channel_names,
    hitch_identities,
)
from truck_blowout_sim.diagnosis.sensors.signals import Signals, read_wheel, smoothed
from truck_blowout_sim.diagnosis.sensors.windows import Windows, make_windows
from truck_blowout_sim.recordings import Recording

FloatArray = NDArray[np.float64]

WHEEL = "steering_wheel_angle_rad"
_FAMILY_P = 1e-4
_PER_CHANNEL = 2.0  # log odds that one more channel of an instrument is wired the other way
_ALIAS = 4.5  # log likelihood ratio within which two readings cannot be told apart
_MOST = 6
_LONGEST_S = 2.0  # of the correlation of a residual
_DELAYS_S = np.arange(0.05, 0.65, 0.05)  # a late channel must not pass for an inverted one
_DRIVES_MPS = 5.0  # no truck reverses faster
_BACKWARD = 20.0  # log odds against one that does, over a whole recording
_WORDS = {"x": "x position", "y": "y position", "yaw": "heading", "roll": "roll", "pitch": "pitch",
          "vx": "forward speed", "vy": "lateral speed", "r": "yaw rate", "p": "roll rate",
          "q": "pitch rate", "ax": "longitudinal acceleration",
          "ay": "lateral acceleration"}  # fmt: skip
_PAIRS = (("vx", "vy"), ("ax", "ay"), ("roll", "pitch"), ("p", "q"), ("p", "r"), ("q", "r"),
          ("x", "y"))  # fmt: skip
_GROUPS = (
    ("accelerometer", ("ax", "ay")),
    ("gyros", ("p", "q", "r")),
    ("velocity", ("vx", "vy")),
    ("lateral acceleration and speed", ("ay", "vy")),
    ("instrument with its z axis down", ("y", "vy", "ay", "yaw", "r", "pitch", "q")),
)


@dataclass(frozen=True)
class FoundConvention:
    """A reading of the log that fits better than what the log states.

    Attributes:
        convention: what to change.
        everywhere: in the baseline recordings too.
        log_ratio: log likelihood ratio against the log as stated.
        tests: how many readings were tried.
        rivals: readings that fit as well.
    """

    convention: Convention
    everywhere: bool
    log_ratio: float
    tests: int
    rivals: tuple[Convention, ...]


def find_conventions(
    signals: Sequence[Signals], is_baseline: Sequence[bool], recordings: Sequence[Recording],
    geometry: Geometry,
) -> tuple[FoundConvention, ...]:  # fmt: skip
    """Signs, exchanges and gravity that are not as stated, the clearest first.

    Args:
        signals: of each recording, as measured.
        is_baseline: flag of each.
        recordings: the same, for the hand wheel.
        geometry: lengths, for what both units share.
    """
    logs = [_Log.of(_with_wheel(s, r), geometry) for s, r in zip(signals, recordings, strict=True)]
    flags = np.array(is_baseline)
    found: list[FoundConvention] = []
    while len(found) < _MOST:
        best = _best(logs, flags)
        if best is None:
            break
        found.append(best)
        logs = [log.read_as(best.convention) if best.everywhere or not baseline else log
                for log, baseline in zip(logs, flags.tolist(), strict=True)]  # fmt: skip
    return tuple(found)


@dataclass(frozen=True)
class _Log:
    """One recording with what its identities leave as it stands.

    ``mounted``: [windows, k] what errors of mounting add to any of them.
    """

    signals: Signals
    identities: tuple[Identity, ...]
    windows: Windows
    left: dict[str, FloatArray]
    mounted: FloatArray

    @classmethod
    def of(cls, signals: Signals, geometry: Geometry) -> _Log:
        """Every identity that the recording has the channels for."""
        asked = [i for unit in ("tractor", "trailer") for i in body_identities(unit)]
        asked += [*hitch_identities(geometry), *articulation_identities()]
        kept = tuple(i for i in asked if i.available(signals))
        windows = make_windows(signals.period_s)
        left = {i.name: _left(i, signals, windows) for i in kept}
        return cls(signals, kept, windows, left, _mounted(signals, windows))

    def read_as(self, convention: Convention) -> _Log:
        """The log under another reading."""
        signals = convention.read(self.signals)
        touched = self._touched(convention)
        left = {i.name: _left(i, signals, self.windows) if i in touched else self.left[i.name]
                for i in self.identities}  # fmt: skip
        return replace(self, signals=signals, left=left)

    def _touched(self, convention: Convention) -> list[Identity]:
        if isinstance(convention, GravityConvention):
            return [i for i in self.identities if "acceleration" in i.name]
        return [i for i in self.identities if set(i.channels) & set(convention.channels)]

    def log_ratio(self, convention: Convention) -> float:
        """Log likelihood of the log so read over that of the log as it stands."""
        signals = convention.read(self.signals)
        total = sum(self._gain(i, signals) for i in self._touched(convention))
        return total + _steered(signals) - _steered(self.signals) + (
            _forward(signals) - _forward(self.signals))

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

    def _gain(self, identity: Identity, signals: Signals) -> float:
        after = _left(identity, signals, self.windows)
        return _gain(self.left[identity.name], after, self.mounted, self.windows)


def _best(logs: Sequence[_Log], is_baseline: NDArray[np.bool_]) -> FoundConvention | None:
    """The reading that fits best, if it fits clearly better than the log as it stands."""
    present = set.intersection(*(set(log.signals.values) for log in logs))
    tried = _readings(present)
    scored: list[tuple[float, int, Convention, bool]] = []
    for order, convention in enumerate(tried):
        gains = np.array([log.log_ratio(convention) for log in logs])
        price = _PER_CHANNEL * (len(convention.channels) - 1)
        there = gains[is_baseline]
        everywhere = bool(there.sum() >= 0.0)
        # what even a run of the sound instrument gains, on a straight, is no sign of a fault
        here = gains[~is_baseline] - (0.0 if everywhere else max(float(there.max()), 0.0))
        total = float(here.sum()) + max(float(there.sum()), 0.0)
        scored.append((total - price, order, convention, everywhere))
    if not scored:
        return None
    scored.sort(key=lambda item: (-item[0], item[1]))
    ratio, _, convention, everywhere = scored[0]
    needed = float(np.log(len(tried) / _FAMILY_P))
    faulty = [log for log, baseline in zip(logs, is_baseline.tolist(), strict=True)
              if everywhere or not baseline]
    if ratio < needed or _merely_late(faulty, convention):
        return None
    rivals = tuple(c for r, _, c, _ in scored[1:] if ratio - r < _ALIAS)
    return FoundConvention(convention, everywhere, ratio, len(tried), rivals)


def _merely_late(logs: Sequence[_Log], convention: Convention) -> bool:
    """Whether a delay of one channel does as well as another sign or axis, over all logs."""
    here = sum(log.log_ratio(convention) for log in logs)
    channels = sorted(set.union(*(log.concerned(convention) for log in logs)))
    return any(sum(log.late_gain(channel, delay_s, convention) for log in logs) > here
               for channel in channels for delay_s in _DELAYS_S.tolist())


def _readings(present: set[str]) -> list[Convention]:
    """Every other way in which the recorded channels could be meant."""
    found: list[Convention] = []
    if WHEEL in present:
        found.append(Sign("channel_sign", "", "hand wheel", (WHEEL,)))
    for unit in ("tractor", "trailer"):
        n = channel_names(unit)
        have = {key: n[key] for key in _WORDS if n[key] in present}
        found += [Sign("channel_sign", unit, f"{unit} {_WORDS[key]}", (channel,))
                  for key, channel in have.items()]  # fmt: skip
        for label, keys in _GROUPS:
            channels = tuple(have[key] for key in keys if key in have)
            if len(channels) > 1:
                found.append(Sign("channel_sign", unit, f"{unit} {label}", channels))
        found += [
            Swap("channel_swap", unit, f"{unit} {_WORDS[a]} and {_WORDS[b]}", (have[a], have[b]))
            for a, b in _PAIRS
            if a in have and b in have
        ]
    for key in ("vx", "vy", "r", "p", "q", "ax", "ay", "roll", "pitch", "yaw"):
        both = tuple(channel_names(unit)[key] for unit in ("tractor", "trailer"))
        if set(both) <= present:
            label = f"{_WORDS[key]} of tractor and trailer"
            found.append(Swap("channel_swap", "", label, both))
    accelerations = tuple(sorted(c for c in present if c.endswith(("_ax_mps2", "_ay_mps2"))))
    if accelerations and any(c.endswith(("_roll_rad", "_pitch_rad")) for c in present):
        found.append(GravityConvention("gravity_convention", "", "accelerometers", accelerations))
    return _unlike(found)


def _unlike(found: Sequence[Convention]) -> list[Convention]:
    """Each reading once; a group that holds one recorded channel is that channel."""
    seen: dict[tuple[str, frozenset[str]], Convention] = {}
    for one in found:
        seen.setdefault((one.name, frozenset(one.channels)), one)
    return list(seen.values())


def _left(identity: Identity, signals: Signals, windows: Windows) -> FloatArray:
    """What the identity leaves under each bump; NaN where it cannot be asked."""
    out = windows.mean(identity.algebraic(signals))
    for channel, factor in identity.rates:
        out = out - factor * windows.derivative(signals[channel])
    return out


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
    both = np.isfinite(before) & np.isfinite(after) & np.isfinite(mounted).all(axis=1)
    if both.sum() < 10:
        return 0.0
    basis, _ = np.linalg.qr(mounted[both])
    old, new = (v[both] - basis @ (basis.T @ v[both]) for v in (before, after))
    bump_s = windows.step * windows.period_s
    count = min(_independent(old, bump_s), _independent(new, bump_s))
    tiny = 1e-12
    ratio = (float(np.var(old)) + tiny) / (float(np.var(new)) + tiny)
    return 0.5 * count * float(np.log(ratio))


def _independent(values: FloatArray, spacing_s: float) -> float:
    """Number of independent values, by the long-run variance over two seconds."""
    moved = values - values.mean()
    power = float(moved @ moved)
    if power <= 0.0:
        return float(values.size)
    lags = min(max(round(_LONGEST_S / spacing_s), 1), values.size - 1)
    weights = 1.0 - np.arange(1, lags + 1) / (lags + 1.0)
    shared = np.array([float(moved[k:] @ moved[:-k]) for k in range(1, lags + 1)]) / power
    # overlapping bumps share half a second: never more than two independent ones in a second
    longest = max(1.0 + 2.0 * float(weights @ shared), 0.5 / spacing_s)
    return float(values.size / longest)


def _with_wheel(signals: Signals, recording: Recording) -> Signals:
    wheel = read_wheel(signals, recording)
    return signals if wheel is None else signals.with_values({WHEEL: wheel})


def _steered(signals: Signals) -> float:
    """Log likelihood of the yaw rate given that the truck turns where the hand wheel points."""
    rate = channel_names("tractor")["r"]
    if WHEEL not in signals or rate not in signals:
        return 0.0
    width = 0.2 / signals.period_s
    wheel, turning = smoothed(signals[WHEEL], width), smoothed(signals[rate], width)
    first = min(signals.blown_since_s.values(), default=np.inf)
    used = np.isfinite(wheel) & np.isfinite(turning) & (signals.time_s < first)
    if used.sum() * signals.period_s < 3.0:
        return 0.0
    a, b = wheel[used] - wheel[used].mean(), turning[used] - turning[used].mean()
    size = float(np.sqrt((a @ a) * (b @ b)))
    alike = float(a @ b) / size if size > 0.0 else 0.0
    every = max(1, round(0.1 / signals.period_s))
    count = _independent(b[::every], every * signals.period_s)
    # noise of both instruments bounds what a correlation can promise
    return -0.5 * count * float(np.log1p(-min(alike, 0.99) ** 2)) if alike > 0.0 else 0.0


def _forward(signals: Signals) -> float:
    """Log odds against a truck that reverses fast."""
    return sum(-_BACKWARD for unit in ("tractor", "trailer")
               for speed in (channel_names(unit)["vx"],) if speed in signals
               and float(np.nan_to_num(np.nanmedian(signals[speed]))) < -_DRIVES_MPS)  # fmt: skip
