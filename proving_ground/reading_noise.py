"""What the instruments and the logger of a case add to each cosine coefficient of a channel.

Variances of white noise, rounding, what readings that are rare leave out, unknown constants, and of
rough logs: noise that remembers, drift, the tone of the frame.

References: Ahmed, Natarajan, Rao, IEEE Trans. Computers C-23 (1974) 90-93 (discrete cosine
transform). White noise stays white in it. Differences of neighbors, which are white in a random
walk, multiply coefficient k of n samples by 2 sin(pi k / 2n).
Known limits: tones above 5 Hz that a slow logger folds down, gaps and clocks are left out, so
sigma_b is a little too large in rough logs; rounding counts as noise.
Validated with: test/proving_ground/test_reading_noise.py (the instruments themselves).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from proving_ground.cases import CaseSpec
from proving_ground.channels import RATE_HZ
from proving_ground.detect import constant_sigma
from proving_ground.instruments import noise_of
from proving_ground.kept_back import KeptBack
from proving_ground.layout import FloatArray
from proving_ground.roughness import OWN, WALK_S, Roughness


@dataclass(frozen=True)
class Instruments:
    """Those of a case, and how rough its log is."""

    kept: KeptBack
    rough: Roughness | None

    @classmethod
    def of(cls, spec: CaseSpec) -> Instruments:
        """Of a case without a faulty instrument."""
        if spec.rough:
            return cls(KeptBack(), Roughness.draw(spec.seed))
        return cls(KeptBack.of(spec.seed), None)

    def keeps(self, channel: str) -> bool:
        """Whether the log has a channel at all."""
        return self.rough is None or self.rough.keeps(channel)

    def variance(self, channel: str, level: float, count: int, duration_s: float) -> FloatArray:
        """[count] of each coefficient of a channel that reads `level` (SI, squared)."""
        noise, own = noise_of(channel), self.kept.reading(channel)
        plain = noise.sigma**2 + (noise.relative * level) ** 2
        white = (plain + own.sigma**2 + (noise.quantum**2 + own.step**2) / 12.0) * own.every
        out = np.full(count, white)
        if self.rough is not None:
            out = out * self.rough.every + _rough(self.rough, channel, plain, noise.quantum, count,
                                                  duration_s)
        out[0] += duration_s * RATE_HZ * constant_sigma(channel) ** 2
        return out


def _rough(rough: Roughness, channel: str, plain: float, quantum: float, count: int,
           duration_s: float) -> FloatArray:
    """What a rough log adds to a channel of variance `plain`."""
    samples, k = duration_s * RATE_HZ, np.arange(count)
    keep = np.exp(-rough.every / (RATE_HZ * rough.memory_s))
    turn = rough.every * np.pi * k / samples
    color = rough.every * (1.0 - keep**2) / (1.0 - 2.0 * keep * np.cos(turn) + keep**2)
    out = plain * OWN.square * rough.noise**2 * color
    out += rough.every * (quantum * max(rough.rounding, 1.0)) ** 2 / 12.0
    step = plain * rough.drift**2 / (WALK_S * RATE_HZ)
    out[0] += step * samples**2 / 3.0
    out[1:] += step / (2.0 * np.sin(0.5 * np.pi * k[1:] / samples)) ** 2
    line = round(2.0 * duration_s * rough.frame_hz)
    if channel.endswith(("_mps2", "_radps")) and not channel.startswith("hub"):
        near = slice(line - 1, line + 2)
        out[near] += plain * OWN.square * rough.frame**2 * samples / 6.0  # half over three
    return np.asarray(out)
