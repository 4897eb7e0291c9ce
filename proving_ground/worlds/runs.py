"""Which runs a case of a world consists of: kinds of manoeuvre that show what is concealed."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

Rng = np.random.Generator
KINDS: dict[str, tuple[str, ...]] = {
    "blowout": ("blowout", "blowout_brake", "blowout_hold", "blowout_coast", "blowout_slow_hands",
                "blowout_dab"),
    "quick steer": ("lane_change", "double_lane_change", "sine_sweep", "slalom", "sine_dwell",
                    "random_steer", "pulse_steer"),
    "hard steer": ("hard_ramp", "hard_double", "hard_slalom", "hard_there_and_back",
                   "hard_fishhook", "hard_s_bend", "lane_change"),
    "steer": ("lane_change", "ramp_hold", "sine_sweep", "slow_ramp", "j_turn", "there_and_back",
              "fishhook", "s_bend", "slalom"),
    "small steer": ("sine_sweep", "weave", "small_pulses", "stairs_steer", "random_steer"),
    "kingpin": ("lane_change", "ramp_hold", "sine_sweep", "slalom", "there_and_back"),
    "limit": ("braking_all", "braking_growing", "hard_ramp", "hard_double"),
    "brake": ("braking_all", "braking_steps", "braking_ramp", "braking_pulses", "braking_release",
              "braking_swap", "braking_growing"),
    "coast": ("coast_down", "coast_slow", "speed_step", "roll_out", "coast_then_brake",
              "dab_and_roll"),
    "straight": ("straight", "coast_down", "late_release", "dab_and_roll", "braking_trailer"),
    "any": ("lane_change", "sine_sweep", "weave", "straight", "coast_down", "ramp_hold"),
}
Kinds = Mapping[str, tuple[str, ...]]
Runs = tuple[tuple[str, ...], tuple[str, ...], tuple[str, ...]]


def choose_runs(needs: list[str], number: int, rng: Rng, kinds: Kinds = KINDS) -> Runs:
    """Kinds of the baseline, training and holdout runs, out of `kinds`.

    `needs` is what each cause needs to show itself; with none, every need in its turn.
    """
    wanted = needs or [list(kinds)[number // 2 % len(kinds)]]
    train, holdout = _two(kinds[wanted[0]], rng), _two(kinds[wanted[0]], rng)
    if len(wanted) > 1:
        other = kinds[wanted[1]]
        train, holdout = (*train, str(rng.choice(other))), (holdout[0], str(rng.choice(other)))
    if wanted[0] == "kingpin":
        train = (*train[:2], str(rng.choice(kinds["blowout"])))
        holdout = (holdout[0], str(rng.choice(kinds["blowout"])))
    elif len(train) < 3 and rng.random() < 0.4:
        train = (*train, str(rng.choice(kinds["any" if wanted[0] == "blowout" else "steer"])))
    baseline = (str(rng.choice(kinds["steer"])),
                str(rng.choice(kinds["coast"] + kinds["brake"])))
    return baseline, train, holdout


def _two(kinds: tuple[str, ...], rng: Rng) -> tuple[str, ...]:
    return tuple(map(str, rng.choice(kinds, 2, replace=False)))
