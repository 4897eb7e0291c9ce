from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from truck_blowout_sim.comparison.noise import channel_sigmas, estimated_sigma
from truck_blowout_sim.recordings import Recording, Series, read_recording

TIME = np.arange(1000) * 0.01


def recording(metadata: dict[str, str], **channels: np.ndarray) -> Recording:
    series = {name: Series(TIME, value) for name, value in channels.items()}
    return Recording("made", series, metadata=metadata)


@pytest.mark.parametrize("sigma", [0.001, 0.05])
def test_white_noise_on_a_moving_signal_is_found(sigma: float) -> None:
    noise = np.random.default_rng(3).normal(scale=sigma, size=TIME.size)
    found = estimated_sigma(Series(TIME, 20.0 - TIME + np.sin(3 * TIME) + noise))
    assert found == pytest.approx(sigma, rel=0.1)


def test_rounding_is_noise_even_at_rest() -> None:
    value = np.where(np.arange(TIME.size) % 400 < 5, 0.02, 0.01)
    assert estimated_sigma(Series(TIME, value)) == pytest.approx(0.01 / np.sqrt(12))


def test_a_smooth_signal_has_no_noise() -> None:
    assert estimated_sigma(Series(TIME, 30.0 + 2.0 * TIME)) is None


def test_a_short_signal_says_nothing() -> None:
    assert estimated_sigma(Series(TIME[:20], np.random.default_rng(0).normal(size=20))) is None


def test_stated_noise_counts_before_what_the_samples_show() -> None:
    metadata = {
        "noise_1sigma_tractor": "velocity 0.012 m/s, rate 0.02 deg/s, acceleration 0.03 m/s2",
        "noise_1sigma_other": "hub speed 0.2 %, chamber pressure 0.3 % + 400 Pa",
    }
    noise = np.random.default_rng(1).normal(size=TIME.size)
    found = channel_sigmas(
        recording(
            metadata,
            tractor_vx_mps=20.0 + noise,
            tractor_yaw_rate_radps=noise,
            trailer_yaw_rate_radps=noise,
            hub_speed_steer_left_radps=np.full(TIME.size, 50.0),
            brake_chamber_steer_left_pa=np.full(TIME.size, 1e5),
        )
    )
    assert found["tractor_vx_mps"].value == pytest.approx(0.012)
    assert found["tractor_yaw_rate_radps"].value == pytest.approx(np.radians(0.02))
    assert found["hub_speed_steer_left_radps"].value == pytest.approx(0.1)
    assert found["brake_chamber_steer_left_pa"].value == pytest.approx(500.0)
    assert found["trailer_yaw_rate_radps"].source == "estimated"
    assert found["trailer_yaw_rate_radps"].value == pytest.approx(1.0, rel=0.1)


def test_an_unknown_unit_leaves_noise_unstated() -> None:
    metadata = {"noise_1sigma_tractor": "velocity 0.1 furlong"}
    noise = np.random.default_rng(2).normal(scale=0.3, size=TIME.size)
    found = channel_sigmas(recording(metadata, tractor_vx_mps=noise))["tractor_vx_mps"]
    assert found.source == "estimated"
    assert found.value == pytest.approx(0.3, rel=0.1)


def test_a_record_rebuilt_from_text_has_no_noise() -> None:
    metadata = {"origin": "rebuilt from the thesis's text"}
    assert not channel_sigmas(recording(metadata, tractor_vx_mps=np.round(TIME, 1)))


def test_estimates_come_near_what_recordings_state(shared_recordings: Path) -> None:
    read = read_recording(shared_recordings / "proving_ground" / "nominal" / "lane_change.csv")
    stated = channel_sigmas(read)
    for name in ("tractor_vx_mps", "tractor_yaw_rate_radps", "trailer_ay_mps2"):
        found = estimated_sigma(read[name])
        assert found is not None
        assert 0.5 < found / stated[name].value < 1.5, name
