"""What an instrument can do to its channels: one small class for each kind.

Measured = true + error. A distortion knows how its channels move per unit of each parameter
(``slope``) and how to take a known amount out again (``undo``). Small amounts of each are normal
mounting errors and tolerances; large ones are faults.

Validated with: test/diagnosis/test_sensors_distortions.py (undo of an injected amount).
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.sensors.identities import channel_names
from truck_blowout_sim.diagnosis.sensors.signals import Signals
from truck_blowout_sim.recordings import Recording, Series
from truck_blowout_sim.recordings.channels import UNITS
from truck_blowout_sim.recordings.gravity import (
    AT_REST_MPS2,
    gravity_is_removed,
    with_gravity_stated,
)

FloatArray = NDArray[np.float64]
Reader = Callable[[str], FloatArray]
"""Gives a channel at the instants in question, zeros where it was not recorded."""


@dataclass(frozen=True)
class Distortion(ABC):
    """A way in which channels of one instrument go wrong.

    Attributes:
        name: canonical name of the fault it is when it is large.
        unit: ``tractor`` or ``trailer`` (empty for a channel of neither).
        instrument: what went wrong, in words.
        channels: channels it touches.
    """

    name: str
    unit: str
    instrument: str
    channels: tuple[str, ...]

    @property
    @abstractmethod
    def parameters(self) -> tuple[tuple[str, str], ...]:
        """Name and unit of each parameter."""

    @abstractmethod
    def slope(self, index: int, channel: str, read: Reader, period_s: float) -> FloatArray:
        """d(measured channel) / d(parameter ``index``), from smooth true signals."""

    def undo(
        self, amounts: tuple[float, ...], channel: str, time_s: FloatArray, value: FloatArray,
        read: Reader,
    ) -> tuple[FloatArray, FloatArray]:  # fmt: skip
        """Times and values of a channel with known amounts taken out."""
        period_s = float(np.median(np.diff(time_s)))
        error = np.zeros_like(value)
        for index, amount in enumerate(amounts):
            error = error + amount * self.slope(index, channel, read, period_s)
        return time_s, value - error

    def grown(self, amounts: FloatArray) -> FloatArray:
        """d(amount in full) / d(amount that is left once these are taken out)."""
        return np.ones_like(amounts)


@dataclass(frozen=True)
class Bias(Distortion):
    """A constant added to the channel; parameter named after what it is."""

    symbol: str = "bias"
    si_unit: str = "rad/s"

    @property
    def parameters(self) -> tuple[tuple[str, str], ...]:
        """One offset."""
        return ((self.symbol, self.si_unit),)

    def slope(self, index: int, channel: str, read: Reader, period_s: float) -> FloatArray:
        """One everywhere."""
        del index, period_s
        return np.ones_like(read(channel))


@dataclass(frozen=True)
class Scale(Distortion):
    """Measured = (1 + scale_error) * true."""

    @property
    def parameters(self) -> tuple[tuple[str, str], ...]:
        """Gain error as a fraction."""
        return (("scale_error", "1"),)

    def grown(self, amounts: FloatArray) -> FloatArray:
        """What is left of a gain multiplies what was taken out."""
        return np.asarray(1.0 + amounts)

    def slope(self, index: int, channel: str, read: Reader, period_s: float) -> FloatArray:
        """The channel itself."""
        del index, period_s
        return read(channel)

    def undo(
        self, amounts: tuple[float, ...], channel: str, time_s: FloatArray, value: FloatArray,
        read: Reader,
    ) -> tuple[FloatArray, FloatArray]:  # fmt: skip
        """Take the excess out of the motion and leave the noise as it is.

        Dividing would shrink the noise with the motion, and a wild gain would then look good.
        """
        return time_s, value - amounts[0] / (1.0 + amounts[0]) * read(channel)


@dataclass(frozen=True)
class Delay(Distortion):
    """Measured(t) = true(t - delay)."""

    @property
    def parameters(self) -> tuple[tuple[str, str], ...]:
        """Seconds late."""
        return (("delay", "s"),)

    def slope(self, index: int, channel: str, read: Reader, period_s: float) -> FloatArray:
        """Minus the time derivative."""
        del index
        return np.asarray(-np.gradient(read(channel), period_s), dtype=np.float64)

    def undo(
        self, amounts: tuple[float, ...], channel: str, time_s: FloatArray, value: FloatArray,
        read: Reader,
    ) -> tuple[FloatArray, FloatArray]:  # fmt: skip
        """Stamp the samples earlier; the values are untouched."""
        del channel, read
        return time_s - amounts[0], value


@dataclass(frozen=True)
class Clock(Distortion):
    """Measured(t) = true(t + clock_rate t): the instrument's own clock runs slow or fast."""

    @property
    def parameters(self) -> tuple[tuple[str, str], ...]:
        """Seconds a second, gained since the recording began."""
        return (("clock_rate", "1"),)

    def slope(self, index: int, channel: str, read: Reader, period_s: float) -> FloatArray:
        """The time derivative, times the time since the beginning."""
        del index
        value = read(channel)
        return np.asarray(period_s * np.arange(value.size) * np.gradient(value, period_s))


@dataclass(frozen=True)
class RollLeak(Distortion):
    """Measured ay = true ay + leak * g * sin(roll)."""

    @property
    def parameters(self) -> tuple[tuple[str, str], ...]:
        """Share of gravity that leaks in."""
        return (("roll_leak", "1"),)

    def slope(self, index: int, channel: str, read: Reader, period_s: float) -> FloatArray:
        """Gravity along the rolled axis."""
        del index, channel, period_s
        return np.asarray(AT_REST_MPS2 * np.sin(read(channel_names(self.unit)["roll"])))


@dataclass(frozen=True)
class Turn(Distortion):
    """The velocity instrument is mounted turned about its vertical axis (a mounting error)."""

    @property
    def parameters(self) -> tuple[tuple[str, str], ...]:
        """Angle, left positive."""
        return (("mounting_angle", "rad"),)

    def slope(self, index: int, channel: str, read: Reader, period_s: float) -> FloatArray:
        """Forward speed read as sideways speed and the reverse."""
        del index, period_s
        n = channel_names(self.unit)
        return read(n["vy"]) if channel == n["vx"] else -read(n["vx"])


@dataclass(frozen=True)
class LevelAxes(Distortion):
    """Velocity stated along level axes, as many navigation units do, and not along the body's."""

    @property
    def parameters(self) -> tuple[tuple[str, str], ...]:
        """Share of the turn from the body's axes to level ones; 1 where they are level."""
        return (("level", "1"),)

    def slope(self, index: int, channel: str, read: Reader, period_s: float) -> FloatArray:
        """What a body that is pitched and rolled has of its forward speed along its own y axis."""
        del index, channel, period_s
        n = channel_names(self.unit)
        return np.asarray(-read(n["vx"]) * np.sin(read(n["pitch"])) * np.sin(read(n["roll"])))


@dataclass(frozen=True)
class LeverArm(Distortion):
    """The instrument sits off from where it is said to sit, along the given directions."""

    directions: tuple[str, ...] = ("forward", "left")

    @property
    def parameters(self) -> tuple[tuple[str, str], ...]:
        """Offset in the unit's axes."""
        return tuple((direction, "m") for direction in self.directions)

    def slope(self, index: int, channel: str, read: Reader, period_s: float) -> FloatArray:
        """Velocity ``w x l``, acceleration ``dw/dt x l + w x (w x l)``, position ``R l``."""
        n = channel_names(self.unit)
        x, y, z = (float(self.directions[index] == d) for d in ("forward", "left", "up"))
        p, q, r = read(n["p"]), read(n["q"]), read(n["r"])
        if channel == n["vx"]:
            return np.asarray(q * z - r * y)
        if channel == n["vy"]:
            return np.asarray(r * x - p * z)
        if channel == n["x"]:
            return np.asarray(np.cos(read(n["yaw"])) * x - np.sin(read(n["yaw"])) * y)
        if channel == n["y"]:
            return np.asarray(np.sin(read(n["yaw"])) * x + np.cos(read(n["yaw"])) * y)
        dp, dq, dr = (np.gradient(rate, period_s) for rate in (p, q, r))
        if channel == n["ax"]:
            return np.asarray(dq * z - dr * y - (q**2 + r**2) * x + p * q * y + p * r * z)
        if channel == n["ay"]:
            return np.asarray(dr * x - dp * z - (r**2 + p**2) * y + p * q * x + q * r * z)
        return np.asarray(dp * y - dq * x - (p**2 + q**2) * z + p * r * x + q * r * y)


@dataclass(frozen=True)
class Convention(Distortion):
    """Another meaning of a channel; there is no amount to estimate."""

    @property
    def parameters(self) -> tuple[tuple[str, str], ...]:
        """None."""
        return ()

    def slope(self, index: int, channel: str, read: Reader, period_s: float) -> FloatArray:
        """Never asked: without parameter there is no slope."""
        raise LookupError(f"{self.name} has no parameter {index}")

    @abstractmethod
    def read(self, signals: Signals) -> Signals:
        """The signals under this meaning."""

    @abstractmethod
    def mended(self, recording: Recording) -> Recording:
        """The recording as the stated convention would have it."""


@dataclass(frozen=True)
class Sign(Convention):
    """The channels are positive the other way."""

    def read(self, signals: Signals) -> Signals:
        """With the signs changed."""
        return signals.with_values({c: -signals[c] for c in self.channels if c in signals})

    def mended(self, recording: Recording) -> Recording:
        """With the signs changed."""
        return recording.with_channels({
            c: Series(recording[c].time_s, -recording[c].value)
            for c in self.channels if c in recording})  # fmt: skip


@dataclass(frozen=True)
class Swap(Convention):
    """Two channels are exchanged."""

    def read(self, signals: Signals) -> Signals:
        """Exchanged again."""
        first, second = self.channels
        if first not in signals or second not in signals:
            return signals
        return signals.with_values({first: signals[second], second: signals[first]})

    def mended(self, recording: Recording) -> Recording:
        """Exchanged again."""
        first, second = self.channels
        if first not in recording or second not in recording:
            return recording
        return recording.with_channels({first: recording[second], second: recording[first]})


@dataclass(frozen=True)
class GravityConvention(Convention):
    """Accelerations said to be free of gravity are not, or the reverse: of one unit, or of all."""

    @property
    def units(self) -> tuple[str, ...]:
        """Whose accelerometers."""
        return (self.unit,) if self.unit else UNITS

    def leaked(self, signals: Signals, share: float) -> Signals:
        """With a share of gravity read where it was said to be removed, and the reverse."""
        moved = {unit: signals.gravity[unit] + share * (1.0 - 2.0 * signals.gravity[unit])
                 for unit in self.units}
        return replace(signals, gravity={**signals.gravity, **moved})

    def read(self, signals: Signals) -> Signals:
        """With gravity read where it was said to be removed, and the reverse."""
        return self.leaked(signals, 1.0)

    def mended(self, recording: Recording) -> Recording:
        """With the statement in its metadata that holds."""
        for unit in self.units:
            recording = with_gravity_stated(recording, unit,
                                            removed=not gravity_is_removed(recording, unit))
        return recording
