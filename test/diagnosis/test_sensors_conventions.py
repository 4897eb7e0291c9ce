"""Signs, exchanged channels and gravity: read off the log before anything else."""

from __future__ import annotations

from collections.abc import Callable
from types import SimpleNamespace
from typing import cast

import numpy as np
import pytest
from numpy.typing import NDArray
from trial_drive import make_run
from trial_faults import delayed, leaking, remembering

from truck_blowout_sim.diagnosis.sensors import conventions, correct, sensor_gate
from truck_blowout_sim.diagnosis.sensors.conventions import find_conventions
from truck_blowout_sim.diagnosis.sensors.distortions import Sign
from truck_blowout_sim.diagnosis.sensors.geometry import stated_geometry, vehicle_geometry
from truck_blowout_sim.diagnosis.sensors.hubs import axle_identities
from truck_blowout_sim.diagnosis.sensors.reading import Reading
from truck_blowout_sim.diagnosis.sensors.signals import read_signals
from truck_blowout_sim.recordings import Recording, Series
from truck_blowout_sim.recordings.gravity import gravity_felt, gravity_is_removed
from truck_blowout_sim.vehicle import load_vehicle

RUN = make_run(20, 15.0)
WHEEL = "steering_wheel_angle_rad"
FEW = (WHEEL, "tractor_vx_mps", "tractor_yaw_rate_radps", "tractor_ay_mps2", "tractor_vy_mps")


def inverted(*channels: str) -> Callable[[Recording], Recording]:
    return lambda r: r.with_channels({c: Series(r[c].time_s, -r[c].value) for c in channels})


def exchanged(first: str, second: str) -> Callable[[Recording], Recording]:
    return lambda r: r.with_channels({first: r[second], second: r[first]})


def gravity(r: Recording) -> Recording:
    return r.with_metadata(accelerometers="gravity removed")


def names(*runs: Recording) -> list[tuple[str, tuple[str, ...]]]:
    found = find_conventions([read_signals(r) for r in runs], [False] * len(runs),
                             stated_geometry(runs))  # fmt: skip
    return [(f.convention.name, f.convention.channels) for f in found]


@pytest.mark.parametrize(("change", "name", "channels"), [
    (inverted("tractor_yaw_rate_radps"), "channel_sign", ("tractor_yaw_rate_radps",)),
    (inverted("trailer_ay_mps2"), "channel_sign", ("trailer_ay_mps2",)),
    (inverted("tractor_vy_mps"), "channel_sign", ("tractor_vy_mps",)),
    (inverted("tractor_roll_rad"), "channel_sign", ("tractor_roll_rad",)),
    (inverted(WHEEL), "channel_sign", (WHEEL,)),
    (exchanged("tractor_ax_mps2", "tractor_ay_mps2"), "channel_swap",
     ("tractor_ax_mps2", "tractor_ay_mps2")),
    (exchanged("tractor_yaw_rate_radps", "trailer_yaw_rate_radps"), "channel_swap",
     ("tractor_yaw_rate_radps", "trailer_yaw_rate_radps")),
    (exchanged("hub_speed_trailer_1_left_radps", "hub_speed_trailer_1_right_radps"), "channel_swap",
     ("hub_speed_trailer_1_left_radps", "hub_speed_trailer_1_right_radps")),
])  # fmt: skip
def test_a_reading_that_is_not_as_stated_is_named(
    change: Callable[[Recording], Recording], name: str, channels: tuple[str, ...]
) -> None:
    assert names(change(RUN)) == [(name, channels)]


@pytest.mark.parametrize("change", [
    inverted("tractor_ay_mps2"), exchanged("tractor_roll_rate_radps", "tractor_pitch_rate_radps"),
])  # fmt: skip
def test_sound_baseline_runs_do_not_hide_it(change: Callable[[Recording], Recording]) -> None:
    """What baseline runs would lose by the other reading is no sign of a delay."""
    gate = sensor_gate([change(RUN)], [make_run(21, 15.0)])
    assert [f.name for f in gate.findings] == ["channel_" + (
        "swap" if change.__qualname__.startswith("exchanged") else "sign")]
    assert not gate.findings[0].in_baseline


def test_gravity_that_is_said_to_be_removed_and_is_not() -> None:
    assert [name for name, _ in names(gravity(RUN))] == ["gravity_convention"]


def without_gravity(unit: str, *stems: str) -> Callable[[Recording], Recording]:
    """Some accelerations of a unit without gravity, which the log goes on calling strapdown."""
    return lambda r: r.with_channels({f"{unit}_{s}": Series(
        r[f"{unit}_{s}"].time_s, r[f"{unit}_{s}"].value - gravity_felt(
            s, r[f"{unit}_roll_rad"].value, r[f"{unit}_pitch_rad"].value)) for s in stems})


@pytest.mark.parametrize("unit", ["tractor", "trailer"])
def test_the_accelerometers_of_one_unit_may_treat_gravity_otherwise(unit: str) -> None:
    spoilt = without_gravity(unit, "ax_mps2", "ay_mps2", "az_mps2")(RUN)
    channels = tuple(f"{unit}_{stem}" for stem in ("ax_mps2", "ay_mps2", "az_mps2"))
    assert names(spoilt) == [("gravity_convention", channels)]
    (finding,) = sensor_gate([spoilt]).findings
    mended = finding.distortion.mended(spoilt)
    other = {"tractor": "trailer", "trailer": "tractor"}[unit]
    assert gravity_is_removed(mended, unit)
    assert not gravity_is_removed(mended, other)


def test_a_vertical_accelerometer_tells_where_the_body_hardly_leans() -> None:
    """On a straight nothing else does; a level vertical axis alone is no treatment of gravity."""
    straight = make_run(20, 15.0, steer=0.0)
    free = without_gravity("trailer", "ax_mps2", "ay_mps2", "az_mps2")
    assert [name for name, _ in names(free(straight))] == ["gravity_convention"]
    assert "gravity_convention" not in [
        name for name, _ in names(without_gravity("trailer", "az_mps2")(RUN))]


def test_with_few_channels_the_hand_wheel_decides_which_one_is_inverted() -> None:
    few = RUN.only_channels(FEW)
    assert names(inverted("tractor_yaw_rate_radps")(few)) == [
        ("channel_sign", ("tractor_yaw_rate_radps",))
    ]


def test_a_sound_log_and_a_late_channel_are_left_as_they_are() -> None:
    assert names(RUN) == []
    assert names(delayed(["tractor_yaw_rate_radps"], 0.2)(RUN)) == []


def test_a_disturbed_channel_is_not_exchanged_for_a_quiet_one_on_a_straight() -> None:
    """What is exchanged must fit in both places; here only that of the quiet one does."""
    straight = make_run(20, 15.0, steer=0.05)
    slow, pushed = straight["trailer_vy_mps"], straight["tractor_ay_mps2"]
    run = straight.with_channels({
        "trailer_vy_mps": Series(slow.time_s, slow.value + 0.1 * np.sin(3.0 * slow.time_s)),
        "tractor_ay_mps2": Series(pushed.time_s, pushed.value + 0.4 * np.sin(2.2 * pushed.time_s)),
    })
    assert "channel_swap" not in [name for name, _ in names(run)]


def test_two_faults_of_wiring_are_found_one_after_the_other() -> None:
    both = inverted("tractor_yaw_rate_radps")(exchanged("trailer_ax_mps2", "trailer_ay_mps2")(RUN))
    assert {name for name, _ in names(both)} == {"channel_sign", "channel_swap"}


def test_the_gate_states_it_and_the_correction_undoes_it() -> None:
    spoilt = inverted("tractor_yaw_rate_radps")(RUN.only_channels(FEW))
    (finding,) = sensor_gate([spoilt]).findings
    assert finding.name == "channel_sign"
    assert "opposite sign" in finding.sentence
    mended = correct(spoilt, [finding])
    assert np.array_equal(mended["tractor_yaw_rate_radps"].value,
                          RUN["tractor_yaw_rate_radps"].value)  # fmt: skip
    assert "channel_sign" in mended.metadata["sensor_correction"]


def test_how_an_instrument_is_mounted_says_nothing_of_its_sign() -> None:
    """On the straight another sign of a channel changes nothing but a constant."""
    rng = np.random.default_rng(3)
    t = np.arange(0.0, 15.0, 0.01)
    levels = {"vx_mps": (20.0, 0.012), "vy_mps": (0.0, 0.012), "yaw_rate_radps": (0.0, 3e-4),
              "ay_mps2": (0.1, 0.03), "roll_rad": (-0.02, 3e-4), "roll_rate_radps": (0.0, 3e-4),
              "pitch_rad": (0.0, 3e-4)}

    def straight(name: str) -> Recording:
        return Recording(name, {f"tractor_{channel}": Series(
            t, level + noise * rng.standard_normal(t.size))
            for channel, (level, noise) in levels.items()})

    assert names(straight("one"), straight("two"), straight("three")) == []


class Gained:
    """A log of which every other reading of one channel gains so much."""

    def __init__(self, gain: float) -> None:
        self.gain = gain
        self.signals = SimpleNamespace(values={"trailer_vy_mps": np.zeros(3)})

    def log_ratio(self, convention: object) -> float:
        return self.gain

    def concerned(self, convention: object) -> set[str]:
        return set()

    def share_explained(self, convention: object) -> NDArray[np.float64]:
        return np.ones(2)


@pytest.mark.parametrize(("train", "baseline", "is_found"), [
    ((9.5, 9.5), (-40.0,), True),
    ((9.5, 9.5), (-40.0, 5.0), False),  # the sound instrument gains half as much on a straight
    ((30.0, 30.0), (-40.0, 5.0), True),
    ((9.5, 9.5), (5.0,), True),  # reversed in all runs
])  # fmt: skip
def test_what_a_sound_run_gains_too_is_no_sign_of_a_fault(
    train: tuple[float, ...], baseline: tuple[float, ...], is_found: bool
) -> None:
    logs = cast("list[conventions.Reading]", [Gained(gain) for gain in (*train, *baseline)])
    flags = np.array([False] * len(train) + [True] * len(baseline))
    assert (conventions._best(logs, flags) is not None) == is_found


TRACTOR = RUN.only_channels([name for name in RUN.channels if not name.startswith("trailer")])


def test_a_share_of_gravity_is_no_other_treatment_of_it() -> None:
    """A sideways accelerometer that misses 70 % of it is not one that is free of gravity."""
    assert names(leaking("tractor", -0.7)(TRACTOR)) == []
    assert names(gravity(TRACTOR)) == [("gravity_convention", (
        "tractor_ax_mps2", "tractor_ay_mps2", "tractor_az_mps2"))]  # fmt: skip


def test_all_of_gravity_through_roll_may_be_another_treatment_of_it() -> None:
    (finding,) = sensor_gate([leaking("tractor", -1.0)(TRACTOR)]).findings
    assert {"gravity_convention", "lateral_accel_roll"} <= set(finding.aliases)


def braking_askew(seed: int) -> Recording:
    """Straight braking; the trailer crabs by 0.2 deg, and its heading reads 0.4 deg too much."""
    rng, t, askew = np.random.default_rng(seed), np.arange(0.0, 20.0, 0.01), 0.0035
    speed, still = 25.0 - t, np.zeros(t.size)
    meant = {WHEEL: (still, 1e-3), "tractor_vy_mps": (still, 0.02),
             "trailer_vy_mps": (askew * speed, 0.02), "tractor_yaw_rad": (still, 1e-4),
             "trailer_yaw_rad": (still + askew, 1e-4)}  # fmt: skip
    for unit in ("tractor", "trailer"):
        meant |= {f"{unit}_vx_mps": (speed, 0.02), f"{unit}_yaw_rate_radps": (still, 1e-3)}
    return Recording(f"straight_{seed}", {
        name: Series(t, values + sigma * rng.standard_normal(t.size))
        for name, (values, sigma) in meant.items()})  # fmt: skip


def test_an_angle_that_is_mounted_askew_is_not_of_the_other_sign() -> None:
    """The side speed that it adds falls with the speed; another sign would take it away as well."""
    runs = [braking_askew(seed) for seed in range(4)]
    truck = vehicle_geometry(load_vehicle("international_9400i_trailmobile"))
    assert find_conventions([read_signals(r) for r in runs], [False] * 4, truck) == ()


def share(change: Callable[[Recording], Recording], channel: str) -> float:
    """What reading a channel with the other sign explains of the log, changed."""
    run = change(RUN)
    product, square = Reading.of(read_signals(run), stated_geometry([run])).share_explained(
        Sign("channel_sign", "tractor", "", (channel,)))
    return float(product / square)


def test_another_sign_explains_nothing_of_a_sound_log_all_of_a_mirrored_one_half_of_noise() -> None:
    def only_noise(run: Recording) -> Recording:
        t = run["tractor_vy_mps"].time_s
        noise = remembering(t, 0.5, np.random.default_rng(2))
        return run.with_channels({"tractor_vy_mps": Series(t, noise)})

    assert share(lambda run: run, "tractor_vy_mps") == pytest.approx(0.0, abs=0.1)
    assert share(inverted("tractor_vy_mps"), "tractor_vy_mps") == pytest.approx(1.0, abs=0.1)
    assert share(only_noise, "tractor_vy_mps") == pytest.approx(0.5, abs=0.1)


def test_what_explains_half_of_what_is_left_is_noise_whatever_it_gains() -> None:
    log = Gained(30.0)
    log.share_explained = lambda _: np.array([0.58, 1.0])  # type: ignore[method-assign]
    logs = cast("list[conventions.Reading]", [log])
    assert conventions._best(logs, np.array([False])) is None


@pytest.mark.parametrize("rad_s", [0.0, 0.5])
def test_hubs_that_do_not_turn_say_nothing_of_their_plugs(rad_s: float) -> None:
    still = {c: Series(RUN[c].time_s, np.full_like(RUN[c].value, rad_s))
             for c in RUN.channels if c.startswith("hub_speed_")}
    signals = read_signals(RUN.with_channels(still))
    assert axle_identities(signals, stated_geometry([RUN])) == ()
    assert len(axle_identities(read_signals(RUN), stated_geometry([RUN]))) == 3
