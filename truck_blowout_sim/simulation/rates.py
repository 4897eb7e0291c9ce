"""Which steps and rates a simulation takes."""

from __future__ import annotations

import math

from truck_blowout_sim.errors import InputError

# with margin to 0.0071 s, up to which it is steady (config/diagnosis/default.yaml, coarsest_step_s)
LONGEST_STEP_S = 0.005


def check_step(step_s: float) -> None:
    """Refuse a step that is none, or too long for the model.

    Raises:
        InputError: says which steps are possible.
    """
    if not (math.isfinite(step_s) and 0.0 < step_s <= LONGEST_STEP_S):
        raise InputError(f"step_s is {step_s!r}",
                         expected=f"a step over 0 and up to {LONGEST_STEP_S:g} s")


def check_rates(step_s: float, rate_hz: float) -> None:
    """Refuse a step, or a rate of the recording, that is impossible.

    Raises:
        InputError: says what is possible.
    """
    check_step(step_s)
    if not (math.isfinite(rate_hz) and 0.0 < rate_hz <= 1.0 / step_s * 1.001):
        raise InputError(f"rate_hz is {rate_hz!r}",
                         expected=f"a rate over 0 and up to {1.0 / step_s:g} Hz, one row a step")
