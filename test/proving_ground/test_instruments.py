from __future__ import annotations

import numpy as np
import pytest

from proving_ground.channels import columns, ideal
from proving_ground.detect import channel_power, detectability, noise_spectrum
from proving_ground.instruments import (
    DEG,
    Fault,
    Mounting,
    apply_fault,
    measure,
    noise_of,
    without_gravity,
)
from proving_ground.manoeuvres import make
from proving_ground.run import Rig, Truth, drive
from proving_ground.switches import neutral

Values = dict[str, np.ndarray]


@pytest.fixture(scope="module")
def truth(rig: Rig) -> Truth:
    return drive(rig, make("random_steer", 21), neutral(), 21)


@pytest.fixture(scope="module")
def clean(truth: Truth) -> Values:
    return ideal(truth)


def test_columns_are_the_promised_ones(clean: Values) -> None:
    assert list(clean) == columns()
    assert len(columns()) == 5 + 2 * 13 + 10 + 18 + 10


@pytest.mark.parametrize(("channel", "sigma"), [
    ("tractor_yaw_rate_radps", 0.02 * DEG), ("trailer_ay_mps2", 0.06), ("tractor_vx_mps", 0.012),
    ("trailer_roll_rad", 0.05 * DEG), ("steering_wheel_angle_rad", 0.04 * DEG)])
def test_noise_has_the_stated_sigma(channel: str, sigma: float, clean: Values) -> None:
    readings = measure({channel: clean[channel]}, Mounting({}, {}), 3)
    error = readings[channel] - clean[channel]
    quantum = noise_of(channel).quantum
    assert np.std(error) == pytest.approx(np.hypot(sigma, quantum / np.sqrt(12.0)), rel=0.08)
    steps = readings[channel] / quantum
    assert np.allclose(steps, np.round(steps), atol=1e-6)


def test_accelerometer_agrees_with_the_motion(clean: Values) -> None:
    turn = clean["tractor_yaw_rate_radps"]
    sway = np.gradient(clean["tractor_vy_mps"]) * 100.0 + clean["tractor_vx_mps"] * turn
    rolled = 9.81 * np.sin(clean["tractor_roll_rad"])
    inner = slice(100, -100)
    assert np.std((clean["tractor_ay_mps2"] - sway - rolled)[inner]) < 0.05


def test_removed_gravity_leaves_level_acceleration(clean: Values) -> None:
    level = without_gravity(clean)
    assert abs(level["tractor_az_mps2"].mean()) < 0.02
    leak = apply_fault(level, Fault("lateral_accel_roll", ("tractor_ay_mps2",), 1.0))
    gap = leak["tractor_ay_mps2"] - clean["tractor_ay_mps2"]
    assert np.abs(gap).max() < 0.02
    assert np.array_equal(leak["trailer_ay_mps2"], level["trailer_ay_mps2"])


def test_moved_instrument_turns_with_the_body() -> None:
    rate, count = 0.3, 400
    names = [name for name in columns() if name.startswith("tractor_")]
    still = {name: np.zeros(count) for name in names}
    still["tractor_yaw_rate_radps"] = np.full(count, rate)
    moved = apply_fault(still, Fault("lever_arm", ("tractor_vx_mps",), 1.0, (2.0, 0.5, 0.0)))
    middle = count // 2
    assert moved["tractor_vy_mps"][middle] == pytest.approx(2.0 * rate)
    assert moved["tractor_vx_mps"][middle] == pytest.approx(-0.5 * rate)
    assert moved["tractor_ax_mps2"][middle] == pytest.approx(-2.0 * rate**2)
    assert moved["tractor_ay_mps2"][middle] == pytest.approx(-0.5 * rate**2)


def test_delay_shifts_one_channel_only(clean: Values) -> None:
    late = apply_fault(clean, Fault("channel_delay", ("tractor_yaw_rate_radps",), 0.05))
    assert np.allclose(late["tractor_yaw_rate_radps"][105:],
                       clean["tractor_yaw_rate_radps"][100:-5])
    assert late["tractor_ay_mps2"] is clean["tractor_ay_mps2"]


def test_unknown_fault_is_refused(clean: Values) -> None:
    with pytest.raises(ValueError, match="no instrument fault"):
        apply_fault(clean, Fault("gremlin", ("tractor_vx_mps",), 1.0))


def test_detectability_grows_with_signal_and_runs(clean: Values) -> None:
    def shifted(size: float) -> Values:
        return apply_fault(clean, Fault("yaw_rate_bias", ("tractor_yaw_rate_radps",), size))

    one, channel = detectability([(shifted(0.01), clean)])
    double, _ = detectability([(shifted(0.02), clean)])
    twice, _ = detectability([(shifted(0.01), clean)] * 2)
    assert channel == "tractor_yaw_rate_radps"
    assert double == pytest.approx(2.0 * one)
    assert twice == pytest.approx(np.sqrt(2.0) * one)
    assert detectability([(clean, clean)])[0] == 0.0
    assert detectability([(shifted(0.01), clean)], ("tractor_yaw",))[0] == 0.0


def test_detectability_is_the_matched_filter_of_its_own_noise() -> None:
    rng = np.random.default_rng(5)
    count, channel = 1024, "tractor_ay_mps2"
    time = np.arange(count) / 100.0
    signal = 0.2 * np.sin(2.0 * np.pi * 0.9 * time)
    spectrum = noise_spectrum(channel, 1.0, count)
    scores = []
    for _ in range(300):
        shape = rng.standard_normal(spectrum.size) + 1j * rng.standard_normal(spectrum.size)
        noise = np.fft.irfft(shape * np.sqrt(spectrum * count / 2.0), count)
        weight = np.fft.irfft(np.fft.rfft(signal) / spectrum, count)
        scores.append(float(weight @ noise))
    power = channel_power(channel, signal, np.zeros(count))
    level = channel_power(channel, signal, np.zeros(count)) ** 0.5
    assert np.std(scores) == pytest.approx(level, rel=0.15)
    assert float(weight @ signal) == pytest.approx(power, rel=0.02)
