"""Recordings made up for tests: every number different, so that no mix-up goes unseen."""

from __future__ import annotations

import numpy as np
import pytest

from truck_blowout_sim.recordings import Blowout, Channel, Recording, Series, channels_for


def made_up(channel: Channel, index: int, time_s: np.ndarray) -> np.ndarray:
    """Values within a channel's bounds, of a size that fits its unit."""
    size = {"Pa": 5e4, "rad": 0.3, "1": 0.1, "m": 50.0}.get(channel.unit, 5.0)
    middle = {"Pa": 3e5, "1": 0.5}.get(channel.unit, 0.0)
    return middle + size * np.sin(1.3 * time_s + index) * (1 + 0.001 * index)


@pytest.fixture(scope="session")
def full_recording() -> Recording:
    """Every channel that has a place in a bag, at 100 Hz, 50 Hz and 20 Hz, with gaps and events."""
    channels = {}
    for index, channel in enumerate(c for c in channels_for() if c.place):
        rate_hz = {"brake_chamber": 50, "tire_pressure": 20}.get(channel.group, 100)
        time_s = np.arange(3 * rate_hz + 1) / rate_hz
        channels[channel.name] = Series(time_s, made_up(channel, index, time_s))
    for name, keep in (("tractor_vy_mps", slice(50, 200)), ("trailer_ax_mps2", slice(0, 300, 3))):
        whole = channels[name]
        channels[name] = Series(whole.time_s[keep], whole.value[keep])
    blowouts = (
        Blowout(1.0, ("steer_left",)),
        Blowout(1.505, ("drive_1_left_outer", "drive_1_left_inner")),
    )
    return Recording("full", channels, blowouts, {"test": "made up", "note": "ü, «quotes», 100 %"})


@pytest.fixture(scope="session")
def sparse_recording() -> Recording:
    """Few channels, time from before zero: as the record of an instrumented test."""
    time_s = np.round(-4.92 + 0.01 * np.arange(1499), 9)
    names = ("steering_wheel_angle_rad", "tractor_vx_mps", "tractor_yaw_rate_radps", "tractor_x_m")
    channels = {
        name: Series(time_s, np.cos(0.1 * time_s * (i + 1))) for i, name in enumerate(names)
    }
    return Recording("sparse", channels, (Blowout(0.0, ("steer_left",)),), {})
