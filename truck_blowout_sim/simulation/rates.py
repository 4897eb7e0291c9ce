"""Which steps and rates a simulation takes, and which a truck's brake lines do."""

from __future__ import annotations

import math

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.physics.layout import TOPOLOGY
from truck_blowout_sim.vehicle import Packed
from truck_blowout_sim.vehicle.schema.axle import CIRCUITS

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


def check_delays(packed: Packed, step_s: float) -> None:
    """Refuse a brake delay that is longer than the samples of its line at this step.

    Raises:
        InputError: says which circuit, and how long its delay may be.
    """
    # two samples are those between which a delay falls
    longest_s = (int(packed.topology[TOPOLOGY.line_length]) - 2) * step_s
    for circuit in CIRCUITS:
        delay_s = sum(packed[f"circuit.{circuit}.{key}"] for key in ("delay_s", "delay_extra_s"))
        if delay_s > longest_s:
            raise InputError(f"the {circuit} brakes come {delay_s:g} s late",
                             file=packed.vehicle.name,
                             expected=f"at most {longest_s:g} s with a step of {step_s:g} s")
