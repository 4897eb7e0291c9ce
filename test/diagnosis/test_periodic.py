"""Lines in what a model leaves: false alarms on colored noise, lines that were put in."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.signal import lfilter

from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.locate.lines import (
    WAVES_PER_M,
    Lines,
    Signal,
    tone_lines,
    turn_lines,
    wave_lines,
)
from truck_blowout_sim.diagnosis.locate.periodic import (
    by_chance,
    clearest,
    find_beat,
    times_as_strong,
)
from truck_blowout_sim.recordings import Recording, Series

Studies = Callable[..., Study]
RATE_HZ = 100.0
SIGMA = 0.03
PER_M = np.linspace(0.30, 0.34, 200)
PACES_HZ = np.linspace(1.2, 8.0, 300)
CHANNELS = ("tractor_ax_mps2", "tractor_az_mps2", "trailer_ax_mps2", "trailer_az_mps2")
TURN_M = 3.14
RATE = 0.0005  # of false alarms
WHATEVER = float("inf")


class Ride:
    """One run: a speed that drifts, resonant road noise, and what is added to it."""

    def __init__(self, seed: int, length_s: float = 14.0) -> None:
        self.rng = np.random.default_rng([seed, 97])
        self.time_s = np.arange(0.0, length_s, 1.0 / RATE_HZ)
        self.speed = 22.0 - 0.25 * self.time_s
        self.way = np.concatenate(([0.0], np.cumsum(self.speed[1:]))) / RATE_HZ
        self.recording = Recording("ride", {"tractor_vx_mps": Series(self.time_s, self.speed)})

    def noise(self, hz: float = 2.0) -> NDArray[np.float64]:
        """White noise of the instrument, and a body that bounces at its own frequency."""
        turn, damping = 2.0 * np.pi * hz / RATE_HZ, 0.97
        road = lfilter([0.02], [1.0, -2.0 * damping * np.cos(turn), damping**2],
                       self.rng.standard_normal(self.time_s.size))
        return np.asarray(road + SIGMA * self.rng.standard_normal(self.time_s.size))

    def blows(self, size: float) -> NDArray[np.float64]:
        """A half-sine blow over a sixth of each wheel turn."""
        turn = (self.way / TURN_M) % 1.0
        return np.where(turn < 1.0 / 6.0, size * np.sin(6.0 * np.pi * turn), 0.0)

    def signals(self, **added: NDArray[np.float64]
                ) -> dict[str, Signal]:
        """Every channel's noise with what is added to it."""
        return {name: Signal(self.time_s, self.noise() + added.get(name, 0.0),
                             np.zeros_like(self.time_s), SIGMA) for name in CHANNELS}


def turns(seed: int, blow: float = 0.0, baseline: bool = False) -> Lines:
    ride = Ride(seed)
    lines = turn_lines(ride.signals(tractor_az_mps2=ride.blows(blow)), ride.recording, PER_M)
    return replace(lines, baseline=baseline, speed_mps=22.0)


def tones(seed: int, surge: float = 0.0, until_s: float = np.inf) -> Lines:
    ride = Ride(seed)
    wave = surge * np.cos(2.0 * np.pi * 1.7 * ride.time_s) * (ride.time_s < until_s)
    signals = {name: Signal(
        ride.time_s, SIGMA * ride.rng.standard_normal(ride.time_s.size) + (
            wave if name.endswith("_ax_mps2") else 0.0), np.zeros_like(wave), SIGMA)
        for name in CHANNELS}
    return replace(tone_lines(signals, PACES_HZ), speed_mps=22.0)


def test_noise_of_a_body_that_bounces_beats_as_often_as_chance_at_most() -> None:
    pairs = [[turns(2 * seed), turns(2 * seed + 1)] for seed in range(60)]
    found = [clearest(pair, 1.0 / PER_M, "turning", 0.2) for pair in pairs]
    assert sum(beat is not None for beat in found) < 18  # 12 are meant; 18 or more: 1 in 20
    found = [clearest(pair, 1.0 / PER_M, "turning", WHATEVER) for pair in pairs]
    assert all(found)
    for pair in pairs:
        ratios = np.concatenate([part.ratios for part in pair])
        score = (ratios.sum(axis=0) - len(ratios)) / np.sqrt(len(ratios))
        assert score.max() < by_chance(len(ratios), PER_M.size, 0.001)


def test_power_over_background_has_mean_one_where_nothing_beats() -> None:
    turning = np.mean([turns(seed).ratios.mean() for seed in range(20)])
    steady = np.mean([tones(seed).ratios.mean() for seed in range(20)])
    assert turning == pytest.approx(1.0, abs=0.15)
    assert steady == pytest.approx(1.0, abs=0.2)


def test_blows_once_a_turn_are_found_at_any_speed_with_their_distance_and_body() -> None:
    beat = clearest([turns(1, blow=0.12), turns(2, blow=0.12)], 1.0 / PER_M, "turning", RATE)
    assert beat is not None
    assert beat.every == pytest.approx(TURN_M, rel=0.003)
    assert beat.body == "tractor"
    assert beat.pace_hz == pytest.approx(22.0 / TURN_M, rel=0.003)
    assert "once per wheel turn" in beat.sentence


def test_a_small_blow_shows_in_the_vertical_channel_of_its_unit_alone() -> None:
    """A light tread on a tractor hardly shakes the trailer, whose channels only add noise."""
    runs = [turns(1, blow=0.045), turns(2, blow=0.045)]
    beat = clearest(runs, 1.0 / PER_M, "turning", RATE)
    assert beat is not None
    assert beat.every == pytest.approx(TURN_M, rel=0.005)
    assert beat.channel == "tractor_az_mps2"
    ratios = np.concatenate([part.ratios for part in runs])
    score = (ratios.sum(axis=0) - len(ratios)) / np.sqrt(len(ratios))
    assert score.max() < by_chance(len(ratios), PER_M.size, RATE)


def test_what_beats_in_the_baseline_too_is_not_missing_physics() -> None:
    train, usual = turns(1, blow=0.12), turns(2, blow=0.12, baseline=True)
    assert clearest([train], 1.0 / PER_M, "turning", RATE) is not None
    assert clearest([train, usual], 1.0 / PER_M, "turning", RATE) is None
    assert clearest([train, turns(3, baseline=True)], 1.0 / PER_M, "turning", RATE) is not None


def test_a_tone_that_meets_the_pace_of_the_wheels_in_one_run_is_no_beat() -> None:
    ride = Ride(1)
    turn = 2.0 * np.pi * ride.way / TURN_M
    hum = 0.3 * (np.sin(turn) + np.sin(2.0 * turn))
    met = turn_lines(ride.signals(tractor_az_mps2=hum), ride.recording, PER_M)
    assert clearest([met], 1.0 / PER_M, "turning", RATE) is not None
    assert clearest([met, turns(2), turns(3)], 1.0 / PER_M, "turning", RATE) is None


@pytest.mark.parametrize("harmonic", [1, 2, 3])
def test_a_tone_that_meets_one_harmonic_of_the_wheels_in_every_run_is_no_beat(
        harmonic: int) -> None:
    def met(seed: int, *harmonics: int) -> Lines:
        ride = Ride(seed)
        hum = sum(0.3 * np.sin(2.0 * np.pi * k * ride.way / TURN_M) for k in harmonics)
        signals = ride.signals(**dict.fromkeys(CHANNELS, np.asarray(hum)))
        return turn_lines(signals, ride.recording, PER_M)

    other = harmonic % 3 + 1
    assert clearest([met(1, harmonic), met(2, harmonic)], 1.0 / PER_M, "turning", RATE) is None
    assert clearest([met(1, harmonic, other), met(2, harmonic, other)], 1.0 / PER_M, True,
                    RATE) is not None


def test_a_steady_tone_is_found_with_its_amplitude() -> None:
    beat = clearest([tones(1, surge=0.03), tones(2, surge=0.03)], 1.0 / PACES_HZ, "steady", RATE)
    assert beat is not None
    assert beat.pace_hz == pytest.approx(1.7, abs=0.1)
    assert beat.amplitude == pytest.approx(0.03, rel=0.2)
    assert beat.channel.endswith("_ax_mps2")


def test_a_tone_must_last_through_the_run() -> None:
    lasting, short = (clearest([tones(1, 0.03, until)], 1.0 / PACES_HZ, "steady", WHATEVER)
                      for until in (np.inf, 8.0))
    assert lasting is not None
    assert short is not None
    assert short.score < 0.2 * lasting.score


def swings(seed: int, left: float = 0.0, model: float = 0.0, baseline: bool = False) -> Lines:
    """Yaw rates of two units that swing every 27 m, beside a model that swings there, too."""
    ride = Ride(seed)
    wave = np.cos(2.0 * np.pi * ride.way / 27.0 + seed)
    signals = {f"{unit}_yaw_rate_radps": Signal(
        ride.time_s, 0.02 * ride.noise(1.0) + size * wave, model * wave, 0.02 * SIGMA)
        for unit, size in (("tractor", 0.0), ("trailer", left))}
    return replace(wave_lines(signals, ride.recording, WAVES_PER_M), baseline=baseline,
                   speed_mps=20.0)


def test_what_swings_at_an_even_distance_is_found_with_its_unit() -> None:
    still = swings(3, baseline=True)
    train = [swings(1, left=0.06), swings(2, left=0.06)]
    beat = clearest([*train, still], 1.0 / WAVES_PER_M, "swinging", RATE)
    assert beat is not None
    assert beat.body == "trailer"
    assert beat.every == pytest.approx(27.0, rel=0.03)
    assert "swings from side to side every 27 m (0.7 times a second" in beat.sentence
    assert beat.amplitude == pytest.approx(0.06, rel=0.2)
    assert "cos(2 pi s / 27" in beat.equation
    assert clearest([*train, swings(3, left=0.06, baseline=True)], 1.0 / WAVES_PER_M, "swinging",
                    RATE) is None
    assert clearest([*train, swings(4), still], 1.0 / WAVES_PER_M, "swinging", RATE) is None


def test_a_model_that_errs_where_the_driver_swings_is_no_swing() -> None:
    """Of a slalom of 0.6 rad/s, the model misses a tenth at the distance of its cones."""
    train = [swings(1, left=0.06, model=0.6), swings(2, left=0.06, model=0.6)]
    assert clearest([*train, swings(3, baseline=True)], 1.0 / WAVES_PER_M, "swinging", RATE) is None


def test_noise_swings_as_often_as_chance_at_most() -> None:
    found = [clearest([swings(3 * k), swings(3 * k + 1), swings(3 * k + 2, baseline=True)],
                      1.0 / WAVES_PER_M, "swinging", 0.2) for k in range(60)]
    assert sum(beat is not None for beat in found) < 18


def test_what_no_instrument_measures_does_not_beat() -> None:
    ride = Ride(1)
    tiny = {name: Signal(ride.time_s, 1e-6 * ride.blows(1.0), np.zeros_like(ride.time_s), SIGMA)
            for name in CHANNELS}
    lines = turn_lines(tiny, ride.recording, PER_M)
    assert lines.ratios.max() < 1e-6
    assert clearest([lines], 1.0 / PER_M, "turning", RATE) is None


def test_without_a_speed_nothing_is_said_of_wheel_turns() -> None:
    ride = Ride(1)
    lines = turn_lines(ride.signals(), Recording("no speed", {}), PER_M)
    assert lines.channels == ()
    assert clearest([lines], 1.0 / PER_M, "turning", RATE) is None


def test_a_steady_tone_is_asked_beside_baseline_runs_only(study_of: Studies) -> None:
    """Engine and frame of every sound vehicle have one."""
    for baseline in (True, False):
        study = study_of(baseline=baseline)
        run = study.runs[-1]
        surge = run.recording["tractor_ax_mps2"]
        loud = Series(surge.time_s, surge.value + 0.5 * np.sin(2.0 * np.pi * 3.1 * surge.time_s))
        runs = (*study.runs[:-1], replace(run, recording=Recording(
            "loud", {**run.recording.channels, "tractor_ax_mps2": loud})))
        assert (find_beat(replace(study, runs=runs)) is not None) == baseline


def test_chance_follows_the_gamma_law_of_summed_powers() -> None:
    powers = np.random.default_rng(4).exponential(size=(20000, 6, 50))
    best = ((powers.sum(axis=1) - 6.0) / np.sqrt(6.0)).max(axis=1)
    assert np.mean(best > by_chance(6, 50, 0.02)) == pytest.approx(0.02, abs=0.004)


@pytest.mark.parametrize("strong", [1.0, 7.0])
def test_the_greatest_of_two_sets_of_powers_differ_by_a_known_factor(strong: float) -> None:
    """Whatever the course's own waves are, as baseline runs have them."""
    powers = strong * np.random.default_rng(5).exponential(size=(40000, 2, 32)).max(axis=2)
    beyond = powers[:, 0] > times_as_strong(32, 0.01) * powers[:, 1]
    assert np.mean(beyond) == pytest.approx(0.01, abs=0.004)


def test_the_factor_grows_as_false_alarms_become_rarer_and_stays_finite() -> None:
    factors = [times_as_strong(32, rate) for rate in (1.0, 0.1, 1e-4, 1e-9, 1e-30)]
    assert factors == sorted(factors)
    assert factors[0] >= 1.0
    assert factors[-1] <= 16.0


def test_a_tone_no_stronger_than_the_waves_of_baseline_runs_is_none() -> None:
    train, other = tones(1, surge=0.03), tones(2)
    loud = replace(other, ratios=np.roll(train.ratios, 120, axis=1), baseline=True)
    assert clearest([train], 1.0 / PACES_HZ, "steady", RATE) is not None
    still = replace(other, baseline=True)
    assert clearest([train, still], 1.0 / PACES_HZ, "steady", RATE) is not None
    assert clearest([train, loud], 1.0 / PACES_HZ, "steady", RATE) is None
