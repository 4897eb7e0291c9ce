"""How far the model is off, channel by channel.

Validated with: test/comparison/test_errors.py, with differences known beforehand.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from truck_blowout_sim.comparison.instruments import good_sigma
from truck_blowout_sim.comparison.iso18571 import Rating, rate
from truck_blowout_sim.comparison.lag import best_lag_s
from truck_blowout_sim.comparison.noise import Sigma
from truck_blowout_sim.comparison.pairing import Pair
from truck_blowout_sim.comparison.units import DisplayUnit

# Below this multiple of its noise a measured channel has no shape that could be rated.
_SIGNAL_OVER_NOISE = 6.0
_ROUNDING = 1e-9  # SI: what is smaller is shown as 0
_MOST_RATED_SAMPLES = 3000
_FEWEST_RATED_SAMPLES = 20


@dataclass(frozen=True)
class ChannelError:
    """Error of one channel, model minus measurement, SI.

    Attributes:
        name: channel.
        label: the quantity in words.
        unit: unit to show it in.
        count: number of instants compared.
        rms: root of the mean square.
        mean: its constant part.
        peak: error of largest size, with its sign.
        peak_time_s: when.
        final: error at the last instant.
        noise: noise of the channel, ``None`` where none is stated or visible.
        rating: after ISO/TS 18571; ``None`` where the measurement has no shape to rate.
        lag_s: how much later the record is than the model; None where no shift makes them alike.
        imposed: the model was made to follow this channel, so its error says nothing.
    """

    name: str
    label: str
    unit: DisplayUnit
    count: int
    rms: float
    mean: float
    peak: float
    peak_time_s: float
    final: float
    noise: Sigma | None
    rating: Rating | None
    imposed: bool = False
    lag_s: float | None = None

    @property
    def rms_sigma(self) -> float | None:
        """Rms error in units of the instrument's stated noise; 1 is all that noise explains.

        None where the recording states none: what its samples scatter by may be the truck.
        """
        return None if self._instrument is None else self.rms / self._instrument

    @property
    def peak_sigma(self) -> float | None:
        """Size of the peak in units of the instrument's stated noise."""
        return None if self._instrument is None else abs(self.peak) / self._instrument

    @property
    def _instrument(self) -> float | None:
        known = self.noise is not None and self.noise.source == "stated"
        return self.noise.value if known and self.noise is not None else None

    def shown(self, value: float) -> str:
        """A value of this channel as a person reads it, three significant digits and the unit."""
        shown = 0.0 if abs(value) < _ROUNDING else value * self.unit.per_si
        return f"{shortened(shown)} {self.unit.symbol}".rstrip()


def channel_error(pair: Pair, label: str, noise: Sigma | None, *, imposed: bool = False
                  ) -> ChannelError:  # fmt: skip
    """Errors and rating of one channel."""
    error = pair.error
    peak = int(np.argmax(np.abs(error)))
    lag_s = best_lag_s(pair, resolved_by(pair, noise)) if moves(pair, noise) else None
    return ChannelError(
        name=pair.name,
        label=label,
        unit=pair.unit,
        count=int(error.size),
        rms=pair.rms,
        mean=float(error.mean()),
        peak=float(error[peak]),
        peak_time_s=float(pair.time_s[peak]),
        final=float(error[-1]),
        noise=noise,
        rating=rating_of(pair, noise),
        imposed=imposed,
        lag_s=lag_s,
    )


def shortened(value: float) -> str:
    """Three significant digits without an exponent where that stays short."""
    text = f"{value:.3g}"
    return f"{value:.0f}" if "e+" in text else text


def resolved_by(pair: Pair, noise: Sigma | None) -> float:
    """The difference that an instrument resolves: a good one, or the better one that is stated."""
    good = good_sigma(pair.name, pair.measured)
    stated = noise is not None and noise.source == "stated"
    return min(good, noise.value) if stated and noise is not None else good


def moves(pair: Pair, noise: Sigma | None) -> bool:
    """Whether the record shows more than its noise, and than what its instrument resolves."""
    sigma = max(resolved_by(pair, noise), 0.0 if noise is None else noise.value)
    return float(np.ptp(pair.measured)) > 2 * _SIGNAL_OVER_NOISE * sigma


def rating_of(pair: Pair, noise: Sigma | None = None) -> Rating | None:
    """Rating on an even grid, ``None`` for a channel that hardly moves or only shows its noise."""
    if not moves(pair, noise):
        return None
    times = pair.time_s
    intervals = float((times[-1] - times[0]) / np.median(np.diff(times)))
    count = min(round(intervals) + 1, _MOST_RATED_SAMPLES)
    if count < _FEWEST_RATED_SAMPLES:
        return None
    grid = np.linspace(times[0], times[-1], count)
    measured = np.interp(grid, times, pair.measured)
    if np.ptp(measured) == 0.0:
        return None
    # relative measures take what no instrument shows for a fault where the truck does little
    seen = pair.model if pair.rms > resolved_by(pair, noise) else pair.measured
    model = np.interp(grid, times, seen)
    return rate(measured, model, float(grid[1] - grid[0]))
