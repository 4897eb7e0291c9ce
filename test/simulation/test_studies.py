"""Many runs: which keys vary and how, one table, failures as rows, the same bits as single runs."""

from __future__ import annotations

import math
import pickle
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.simulation import load_scenario, open_batch, simulate, simulate_batch
from truck_blowout_sim.simulation.drive import Drive
from truck_blowout_sim.simulation.studies import Study, grid, parse_axis, sample
from truck_blowout_sim.simulation.studies.cases import FAILED
from truck_blowout_sim.vehicle import Packed, load_vehicle, pack

Floats = NDArray[np.float64]
TRUCK = "international_9400i_trailmobile"
SHORT = """\
title: a turn, a burst
end_s: 3
start: {speed_mph: 40}
steering:
  table: {time_s: [0.2, 0.6], angle_deg: [0, 60]}
hold: {speed_mph: 40}
blowouts: {failure: {time_s: 1.0, tires: steer_left}}
"""
CHANNELS = ["tractor_yaw_rate_radps", "steering_wheel_angle_rad", "tire_fz_steer_left_n"]


@pytest.fixture(scope="module")
def short(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("study") / "short.yaml"
    path.write_text(SHORT, encoding="utf-8")
    return path


def test_a_batch_has_the_same_bits_as_single_runs(short: Path, truck: Packed) -> None:
    batch = simulate_batch(TRUCK, short, [{"hub.steer_left.brake_gain": 1.0,
                                           "unit.trailer.drag_area_extra_m2": area}
                                          for area in (0.0, 5.0)],
                           channels=CHANNELS, rate_hz=50.0, workers=2)
    for k, area in enumerate((0.0, 5.0)):
        alone = simulate(truck.with_values({"unit.trailer.drag_area_extra_m2": area}),
                         load_scenario(short), rate_hz=50.0)
        np.testing.assert_array_equal(batch.series(CHANNELS[0])[k], alone[CHANNELS[0]].value)
        np.testing.assert_array_equal(batch.series(CHANNELS[1])[k], alone[CHANNELS[1]].value)
    assert batch.time_s == pytest.approx(np.linspace(0.0, 3.0, 151))
    assert batch.column("status") == ["ok", "ok"]


def test_a_batch_takes_a_vehicle_that_is_loaded_or_changed(short: Path, truck: Packed) -> None:
    heavy = truck.with_values({"unit.trailer.drag_area_extra_m2": 50.0})
    speeds = [{"start.speed_mph": mph} for mph in (38.0, 40.0)]
    named, loaded, changed = (
        simulate_batch(vehicle, short, speeds, channels=CHANNELS, rate_hz=50.0).series(CHANNELS[0])
        for vehicle in (TRUCK, truck.vehicle, heavy))
    np.testing.assert_array_equal(loaded, named)
    assert not np.array_equal(changed, named)
    ratio = [{"vehicle.steering.ratio": 18.0}]
    assert simulate_batch(truck.vehicle, short, ratio).column("status") == ["ok"]
    with pytest.raises(InputError, match="other values than its file, of which keys vary"):
        simulate_batch(heavy, short, ratio)


def test_the_keys_of_variants_may_stand_in_any_order(short: Path) -> None:
    one = {"start.speed_mph": 38.0, "hold.speed_mph": 38.0}
    batch = simulate_batch(TRUCK, short, [one, dict(reversed(one.items()))], channels=CHANNELS)
    np.testing.assert_array_equal(*batch.series(CHANNELS[0]))
    with pytest.raises(InputError, match="different keys"):
        simulate_batch(TRUCK, short, [one, {"start.speed_mph": 38.0}])


def test_keys_of_every_file_reach_the_run(short: Path) -> None:
    base = {"start.speed_mph": 40.0, "hold.speed_mph": 40.0, "blowouts.failure.time_s": 1.0,
            "blowouts.*.tires": "steer_left", "units.trailer.payload.*.mass_kg": "1x",
            "tires.steer.pressure_psi": "1x", "vehicle.steering.ratio": 22.0,
            "road.friction_scale": 1.0, "blowout.flat_rolling": "1x", "reaction.time_s": 1.0}
    changes = [{}, {"start.speed_mph": 45.0}, {"blowouts.failure.time_s": 2.0},
               {"blowouts.*.tires": "drive_1_left"}, {"units.trailer.payload.*.mass_kg": "0.5x"},
               {"tires.steer.pressure_psi": "0.8x"}, {"vehicle.steering.ratio": 18.0},
               {"road.friction_scale": 0.5}, {"blowout.flat_rolling": "2x"},
               {"reaction.time_s": math.inf}]
    batch = simulate_batch(TRUCK, short, [base | change for change in changes],
                           channels=CHANNELS, rate_hz=20.0)
    assert batch.column("status") == ["ok"] * len(changes)
    rates = batch.series("tractor_yaw_rate_radps")
    assert len({rate.tobytes() for rate in rates}) == len(changes)
    loads = batch.series("tire_fz_steer_left_n")[:, 0]
    assert loads[4] < loads[0] - 100.0
    assert batch.column("blown_s") == [1.0, 1.0, 2.0, *[1.0] * 7]
    held = batch.series("steering_wheel_angle_rad")[9]
    assert np.ptp(held[21:]) == 0.0


def test_a_failed_run_is_a_row_with_its_reason(short: Path) -> None:
    batch = simulate_batch(TRUCK, short, [{"start.speed_mph": v} for v in (40.0, -3.0, 197.0)],
                           channels=CHANNELS)
    assert batch.column("status") == ["ok", "failed", "failed"]
    reasons = batch.column("reason")
    assert reasons[0] is None
    assert "--vary start.speed_mph: -3.0 is out of bounds" in reasons[1]
    assert "a start speed of 88 m/s" in reasons[2]
    assert batch.column("peak_load_transfer")[1] is None
    assert np.isnan(batch.series(CHANNELS[0])[1:]).all()


def test_a_rollover_is_a_row_up_to_its_instant(short: Path) -> None:
    tall = {"end_s": 8.0, "units.trailer.payload.*.z_m": "1.6x", "road.friction_scale": 1.3}
    batch = simulate_batch(TRUCK, short, [
        tall | {"start.speed_mph": mph, "hold.speed_mph": mph, "vehicle.steering.ratio": ratio}
        for mph, ratio in ((20.0, 22.0), (60.0, 5.0))], channels=CHANNELS)
    assert batch.column("status") == ["ok", "rolled over"]
    assert batch.column("rolled_over") == [False, True]
    instant = batch.column("rolled_over_s")[1]
    assert instant == batch.column("ended_s")[1]
    ended = np.isnan(batch.series(CHANNELS[0])[1])
    later = batch.time_s > instant
    assert ended[later[:ended.size]].all()
    assert not ended[~later[:ended.size]].any()


def test_a_batch_is_streamed_to_a_file_and_read_again(short: Path, tmp_path: Path) -> None:
    shares: list[float] = []
    variants = [{"blowouts.failure.tires": tires} for tires in ("none", "steer_left", "drive_1")]
    streamed = simulate_batch(TRUCK, short, variants, channels=CHANNELS,
                              output=tmp_path / "runs.parquet", progress=shares.append)
    again = open_batch(tmp_path / "runs.parquet")
    assert again.table.equals(streamed.table)
    assert again.column("status") == ["ok", "ok", "failed"]
    assert again.column("blown_s")[0] is None
    assert shares == pytest.approx([1 / 3, 2 / 3, 1.0])


def test_a_study_goes_to_another_process(short: Path) -> None:
    study = Study(TRUCK, short, ["start.speed_mph"], CHANNELS, rate_hz=10.0)
    there = pickle.loads(pickle.dumps(study))
    one, other = study.run(3, {"start.speed_mph": 38.0}), there.run(3, {"start.speed_mph": 38.0})
    np.testing.assert_array_equal(one.series, other.series)
    assert one.measures == other.measures


@pytest.mark.parametrize(("key", "line"), [
    ("start.sped_mph", "did you mean 'start.speed_mph'"),
    ("start.speed_mhp", "did you mean 'start.speed_mph'"),
    ("start.speed_kmh", "did you mean 'start.speed_kmph'"),
    ("start.speed", "did you mean 'start.speed_mps'"),
    ("scenario.strat.speed_mph", "did you mean 'scenario.start.speed_mph'"),
    ("tires.steer.presure_psi", "did you mean 'tires.steer.pressure_psi'"),
    ("road.friction", "did you mean 'road.friction_scale'"),
    ("blowout.flat_roling", "did you mean 'blowout.flat_rolling'"),
    ("payload.mass_kg", "did you mean 'units.trailer.payload.front_block.mass_kg'"),
    ("units.trailer.payload.*.mas_kg", r"did you mean 'units\.trailer\.payload\.\*\.mass_kg'"),
    ("hub.trailer_2_lft.brake_gain", "did you mean 'hub.trailer_2_left.brake_gain'"),
    ("vehcle", "did you mean 'vehicle'"),
    ("steering.table.angle_deg", "no such key"),
    ("", "no such key"),
])
def test_an_unknown_key_names_the_nearest(short: Path, key: str, line: str) -> None:
    with pytest.raises(InputError, match=line):
        Study(TRUCK, short, [key])


def test_a_key_of_both_files_asks_which(short: Path) -> None:
    with pytest.raises(InputError, match=r"expected scenario\.title or vehicle\.title"):
        Study(TRUCK, short, ["title"])
    Study(TRUCK, short, ["scenario.title"])


@pytest.mark.parametrize(("first", "second"), [
    ("start.speed_mph", "start.speed_mps"),
    ("scenario.start.speed_mph", "start.speed_mph"),
    ("tires.steer.pressure_psi", "vehicle.tires.steer.pressure_kpa"),
])
def test_a_quantity_in_two_units_is_refused(short: Path, first: str, second: str) -> None:
    with pytest.raises(InputError, match=f"^--vary '{second}' is given twice, first as '{first}'"):
        Study(TRUCK, short, [first, second])
    Study(TRUCK, short, [first, "end_s", "tires.*.friction_scale"])


def test_an_unknown_channel_names_the_nearest(short: Path) -> None:
    with pytest.raises(InputError, match="did you mean 'tractor_yaw_rate_radps'"):
        Study(TRUCK, short, ["end_s"], ["tractor_yawrate_radps"])


def test_another_vehicle_may_be_a_value(short: Path) -> None:
    study = Study(TRUCK, short, ["vehicle"])
    assert study.run(0, {"vehicle": "international_9400i_trailmobile_thesis"}).status == "ok"
    assert "no vehicle of the name" in study.run(1, {"vehicle": "lorry"}).reason


def test_equal_trucks_settle_once(short: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from truck_blowout_sim.simulation.studies import cases

    settled: list[Packed] = []
    settle = cases.settle_all

    def counted(trucks: Sequence[Packed], drives: Sequence[Drive]) -> list[Floats]:
        settled.extend(trucks)
        return settle(trucks, drives)

    monkeypatch.setattr(cases, "settle_all", counted)
    study = Study(TRUCK, short, ["blowouts.failure.time_s"])
    rows = [study.run(k, {"blowouts.failure.time_s": float(t)}) for k, t in enumerate((1.0, 2.0))]
    assert len(settled) == 1
    assert rows[0].measures != rows[1].measures


@pytest.mark.parametrize(("word", "values"), [
    ("a=1,2,3", [1.0, 2.0, 3.0]),
    ("a=0:1:3", [0.0, 0.5, 1.0]),
    ("a=0.5x:1.5x:3", ["0.5x", "1.0x", "1.5x"]),
    ("a=steer_left,none", ["steer_left", "none"]),
    ("a=0.5,.inf", [0.5, math.inf]),
    ("a=0.5,inf", [0.5, math.inf]),
    ("a=-.Inf,INF", [-math.inf, math.inf]),
    ("a=0.5,.nan", [0.5, ".nan"]),
])
def test_an_axis_is_a_list_or_a_range(word: str, values: list[object]) -> None:
    assert list(parse_axis(word).grid_values()) == values


@pytest.mark.parametrize("word", ["a", "a=", "=1", "a=1:2:0", "a=2:1:3", "a=1:b:3", "a=1,,2",
                                  "a=1,1", "a=1:2:3:4", "a=nan:2:3"])
def test_a_wrong_axis_is_refused(word: str) -> None:
    with pytest.raises(InputError, match=f"^--vary '{word}'"):
        parse_axis(word)


@given(st.text(max_size=30) | st.builds(
    "{}={}".format, st.sampled_from(["", " ", "a"]), st.text("a=:,.x09- \n", max_size=12)))
def test_any_text_is_an_axis_or_one_line(word: str) -> None:
    line = ""
    try:
        axis = parse_axis(word)
    except InputError as error:
        line = str(error)
        axis = None
    assert line.startswith("--vary ") == (axis is None)
    assert "\n" not in line
    assert axis is None or axis.key == word.partition("=")[0].strip() != ""


def test_a_grid_has_every_combination_and_a_range_needs_its_number() -> None:
    rows = grid([parse_axis("a=1,2"), parse_axis("b=x,y,z")])
    assert len(rows) == 6
    assert rows[1] == {"a": 1.0, "b": "y"}
    with pytest.raises(InputError, match="how many values"):
        grid([parse_axis("a=1:2")])


def test_a_grid_beyond_all_memory_is_refused_before_it_is_made() -> None:
    with pytest.raises(InputError, match="1000000000000 runs; expected"):
        grid([parse_axis("a=1:2:1000000000000")])


def test_a_sample_covers_each_axis_evenly_and_repeats() -> None:
    axes = [parse_axis("a=0:10"), parse_axis("b=x,y")]
    rows = sample(axes, 20, seed=4)
    assert rows == sample(axes, 20, seed=4)
    assert rows != sample(axes, 20, seed=5)
    cells = sorted(int(float(row["a"]) / 0.5) for row in rows)
    assert cells == list(range(20))
    assert sum(row["b"] == "x" for row in rows) == 10


def test_the_shipped_truck_is_unchanged_by_a_study(short: Path) -> None:
    key = "unit.trailer.drag_area_extra_m2"
    study = Study(TRUCK, short, [key])
    before = study.run(0, {}).measures
    assert before is not None
    assert study.run(1, {key: 50.0}).measures != before
    assert study.run(2, {}).measures == before
    assert pack(load_vehicle(TRUCK))[key] == 0.0


def test_runs_are_not_held_in_memory(short: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from truck_blowout_sim.simulation.studies.batch import run_all

    study = Study(TRUCK, short, ["start.speed_mph"])
    begun: list[int] = []
    run: Callable[..., object] = study.run_several
    monkeypatch.setattr(study, "run_several", lambda part: (begun.append(len(part)), run(part))[1])
    rows = run_all(study, ((k, {"start.speed_mph": -1.0}) for k in range(1000)), 1, workers=2)
    next(rows)
    assert len(begun) < 40
    rows.close()  # type: ignore[attr-defined]


def test_what_varies_may_put_the_scenario_right(tmp_path: Path, short: Path) -> None:
    """The scenario bursts a tire that this car has not; each run bursts one it has, or none."""
    batch = simulate_batch("bmw_320i", short, [{"blowouts.failure.tires": tires}
                                               for tires in ("front_left", "none", "steer_left")])
    assert batch.column("status") == ["ok", "ok", "failed"]
    assert "steer_left" in batch.column("reason")[2]
    with pytest.raises(InputError, match="steer_left"):
        Study("bmw_320i", short, ["vehicle.steering.ratio"])


def test_a_star_stands_for_the_names_of_the_vehicle_that_runs(short: Path) -> None:
    study = Study(TRUCK, short, ["tires.*.friction_scale", "vehicle", "blowouts.failure.tires"])
    values = {"tires.*.friction_scale": "0.5x", "blowouts.failure.tires": "none"}
    for vehicle in ("rigid_truck", "bmw_320i", TRUCK):
        packed, _, _ = study.prepared({**values, "vehicle": vehicle})
        plain = pack(load_vehicle(vehicle))
        for tire in plain.names.tires:
            name = f"tire.{tire}.friction_scale"
            assert packed[name] == pytest.approx(0.5 * plain[name])


def test_a_star_that_stands_for_nothing_fails_the_run(short: Path) -> None:
    batch = simulate_batch(TRUCK, short, [{"units.trailer.payload.*.mass_kg": "0.5x",
                                           "vehicle": "rigid_truck"}])
    assert batch.column("status") == ["failed"]
    assert "this vehicle has no such key" in batch.column("reason")[0]


def test_a_brake_that_comes_later_than_its_line_is_long_is_refused(short: Path) -> None:
    row = Study(TRUCK, short, ["circuit.trailer.delay_s"]).run(0, {"circuit.trailer.delay_s": 2.0})
    assert row.status == FAILED
    assert "the trailer brakes come 2" in row.reason
