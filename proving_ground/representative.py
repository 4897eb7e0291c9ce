"""Which run stands for a kind of manoeuvre where a world's nulls are measured."""

from __future__ import annotations

REPRESENTATIVE: dict[str, tuple[str, ...]] = {
    "blowout_brake": ("blowout",),
    "braking_steps": ("braking", "roll_and_dabs", "dragging_brake"),
    "coast_down": ("coast", "speed_step", "late_release", "roll_out", "dab_and_roll"),
    "hard_slalom": ("hard",),
    "lane_change": ("lane_change", "ordinary", "double_lane_change", "slalom", "sine_dwell",
                    "swerve"),
    "ramp_hold": ("ramp_hold", "slow_ramp", "j_turn", "there_and_back", "fishhook", "s_bend",
                  "tightening", "lift_in_turn"),
    "sine_sweep": ("sine_sweep", "random_steer", "pulse_steer", "growing_triangles"),
    "weave": ("weave", "straight", "small_pulses", "stairs_steer", "slow_drift"),
}
CAR_REPRESENTATIVE: dict[str, tuple[str, ...]] = {
    "braking_stairs": ("braking",), "coast_down": ("coast", "throttle_steps"),
    "hard_slalom": ("hard",), "bends": ("bends", "ramp_hold"), "sweep": ("sweep",),
    "slalom": ("slalom", "lane_change"), "weave": ("weave", "straight"),
}


def representative(kind: str, car: bool = False) -> str:
    """The kind that stands for another one.

    Raises:
        ValueError: none does.
    """
    for name, beginnings in (CAR_REPRESENTATIVE if car else REPRESENTATIVE).items():
        if kind.startswith(beginnings):
            return name
    raise ValueError(f"no run stands for {kind!r}")
