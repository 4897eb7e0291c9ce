"""A vehicle stated in ten lines: what is stated comes back, the rest has a rule and a spread."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.simulation import InitialState, Inputs, Truck
from truck_blowout_sim.vehicle import Vehicle, load_vehicle, pack, write_vehicle
from truck_blowout_sim.vehicle.packing import packed_spreads
from truck_blowout_sim.vehicle.packing.formula import cornering_nprad
from truck_blowout_sim.vehicle.single_track import RULE
from truck_blowout_sim.vehicle.statics import static_loads

CAR = """title: my car
single_track:
  kind: car
  mass_kg: {value: 1500, spread: 15, source: weighed}
  wheelbase_m: 2.7
  cg_x_m: 1.2
  yaw_inertia_kgm2: 2300
  front_cornering_nprad: 110.0e+3
  rear_cornering_nprad: 130.0e+3
  steering_ratio: 15
  tire: 205/55R16
"""
TRACTOR_TRAILER = """title: my truck
single_track:
  kind: truck
  mass_kg: 8198
  wheelbase_m: 5.994
  cg_x_m: 2.42
  steering_ratio: 22
  tire: 275/80R22.5
  rear_axles: 2
  hitch_x_m: 5.5
  trailer: {mass_kg: 15388, wheelbase_m: 11.2265, cg_x_m: 6.64}
"""
GRAVITY = 9.80665


@pytest.fixture
def car(write: Callable[..., Path]) -> Vehicle:
    return load_vehicle(write(CAR))


@pytest.fixture
def truck(write: Callable[..., Path]) -> Vehicle:
    return load_vehicle(write(TRACTOR_TRAILER, "truck.yaml"))


def mass_kg(vehicle: Vehicle, unit: str) -> float:
    axles = [axle for axle in vehicle.spec.axles.values() if axle.unit == unit]
    return vehicle.unit_specs[unit].body.mass_kg + sum(axle.mass_kg for axle in axles)


def test_stated_mass_and_center_of_gravity_come_back_as_axle_loads(car: Vehicle) -> None:
    loads = static_loads(car, GRAVITY).road_n
    assert mass_kg(car, "tractor") == pytest.approx(1500)
    assert loads["front"] / GRAVITY == pytest.approx(1500 * 1.5 / 2.7)
    assert loads["rear"] / GRAVITY == pytest.approx(1500 * 1.2 / 2.7)


def test_stated_yaw_inertia_is_that_of_the_whole(car: Vehicle) -> None:
    body = car.spec.units.tractor.body
    total = body.izz_kgm2 + body.mass_kg * (body.x_m - 1.2) ** 2
    for axle in car.spec.axles.values():
        total += axle.izz_kgm2 + axle.mass_kg * (axle.x_m - 1.2) ** 2
    assert total == pytest.approx(2300)


def test_stated_axle_stiffness_is_that_of_its_tires_at_rest(car: Vehicle) -> None:
    loads = static_loads(car, GRAVITY).road_n
    for axle, stated in (("front", 110e3), ("rear", 130e3)):
        tire = car.tire_specs[f"{axle}_left"]
        assert 2 * cornering_nprad(tire, loads[axle] / 2) == pytest.approx(stated, rel=1e-3)


def test_loads_of_the_test_truck_come_out_of_ten_lines(truck: Vehicle) -> None:
    loads = static_loads(truck, GRAVITY).road_n
    pounds = {name: load / GRAVITY / 0.45359237 for name, load in loads.items()}
    assert pounds["steer"] == pytest.approx(11_925, rel=0.01)
    assert pounds["drive_1"] + pounds["drive_2"] == pytest.approx(20_004, rel=0.01)
    assert pounds["trailer_1"] + pounds["trailer_2"] == pytest.approx(20_070, rel=0.01)
    assert len(truck.tires) == 18


def test_every_filled_value_names_its_rule_and_its_spread(car: Vehicle) -> None:
    ruled = {key for key, source in car.sources.items() if source.startswith(RULE)}
    assert {"units.tractor.body.ixx_kgm2", "axles.rear.suspension.spring_npm",
            "tires.front.peak_y"} <= ruled  # fmt: skip
    without = {key for key in ruled if key not in car.spreads}
    # a rule may say "none at all", which has no relative spread
    assert all(key.endswith(("equalizer_m", "delay_s")) for key in without), without


def test_stated_spread_is_kept(car: Vehicle) -> None:
    assert car.spreads["units.tractor.body.mass_kg"] == 15


def test_a_value_elsewhere_in_the_file_wins(write: Callable[..., Path]) -> None:
    text = CAR + "steering: {lash_deg: 4}\ntires: {rear: ferrari_250lm_rear}\n"
    text += "blowout: continuous_car\n"
    vehicle = load_vehicle(write(text))
    assert vehicle.spec.steering is not None
    assert vehicle.spec.steering.lash_rad == pytest.approx(0.0698, abs=1e-4)
    assert vehicle.tire_files["rear_left"] == "ferrari_250lm_rear"


def test_it_is_extended_packed_and_written_like_any_other(
        car: Vehicle, write: Callable[..., Path], tmp_path: Path) -> None:
    text = "extends: mine.yaml\nsingle_track: {steering_ratio: 17}\n"
    child = load_vehicle(write(text, "b.yaml"))
    assert child.spec.steering is not None
    assert child.spec.steering.ratio == 17
    written = write_vehicle(tmp_path / "c.yaml", car, {"steering.lash_rad": 0.02})
    assert pack(written).params[pack(written).index["steering.lash_rad"]] == 0.02


@pytest.mark.parametrize(("old", "new", "words"), [
    ("cg_x_m: 1.2", "cg_x_m: 3.1", "between 0 and the wheelbase"),
    ("cg_x_m: 1.2", "cg_x_m: 1.2\n  front_load_kg: 700", "both are given"),
    ("  cg_x_m: 1.2\n", "", "neither is given"),
    ("205/55R16", "sixteen", "is no tire size"),
    ("mass_kg: {value: 1500, spread: 15, source: weighed}", "mass: 1500", "has no unit"),
    ("steering_ratio", "stering_ratio", "did you mean 'steering_ratio'"),
    ("yaw_inertia_kgm2: 2300", "yaw_inertia_kgm2: 40", "less than that of the axles alone"),
    ("spread: 15", "spread: -1", "is no standard deviation"),
    ("tire: 205", "rear_tires_per_axle: 3\n  tire: 205", "3 tires on an axle"),
    ("tire: 205", "trailer: {mass_kg: 900, wheelbase_m: 4, cg_x_m: 3}\n  tire: 205",
     "hitch_x_m is missing"),
])  # fmt: skip
def test_what_does_not_fit_is_one_line(write: Callable[..., Path], refusal: Callable[[Path], str],
                                       old: str, new: str, words: str) -> None:  # fmt: skip
    assert old in CAR
    assert words in refusal(write(CAR.replace(old, new)))


@pytest.mark.parametrize(("old", "new", "place"), [
    ("tire: 275/80R22.5", "tire: foo", r"line 8: single_track\.tire: 'foo'"),
    ("rear_axles: 2", "rear_tire: foo", r"line 9: single_track\.rear_tire: 'foo'"),
    ("6.64}", "6.64, tire: foo}", r"line 11: single_track\.trailer\.tire: 'foo'"),
])  # fmt: skip
def test_a_wrong_tire_size_is_reported_where_it_stands(
        write: Callable[..., Path], old: str, new: str, place: str) -> None:
    assert old in TRACTOR_TRAILER
    with pytest.raises(InputError, match=place):
        load_vehicle(write(TRACTOR_TRAILER.replace(old, new), "truck.yaml"))


def test_a_stated_spread_reaches_the_vehicle(tmp_path: Path) -> None:
    """Of an axle's cornering stiffness as a share of it; of the load in front as a place."""
    path = tmp_path / "car.yaml"
    path.write_text(
        "single_track:\n  kind: car\n  mass_kg: 1500\n  wheelbase_m: 2.7\n"
        "  front_load_kg: {value: 800, spread: 15}\n  steering_ratio: 16\n  tire: 205/55R16\n"
        "  front_cornering_nprad: {value: 120000, spread: 12000}\n"
        "  tire_pressure_pa: {value: 230000, spread: 10000}\n"
        "  power_w: {value: 90000, spread: 9000}\n", encoding="utf-8")
    car = pack(load_vehicle(path))
    found, body = packed_spreads(car), car["unit.tractor.mass_kg"]
    assert found["tire.front_left.cornering_scale"] == pytest.approx(0.1)
    assert found["tire.rear_left.pressure_pa"] == pytest.approx(10000.0)
    assert found["driveline.power_w"] == pytest.approx(9000.0)
    assert found["unit.tractor.origin_x_m"] == pytest.approx(2.7 * 15.0 / body)


def test_a_flat_tire_stands_on_the_rim_of_its_own_size(write: Callable[..., Path]) -> None:
    """A low-loader: its small trailer tires have their own rim, radius and belt."""
    text = TRACTOR_TRAILER.replace("275/80R22.5", "315/80R22.5").replace(
        "cg_x_m: 6.64}", "cg_x_m: 6.64, tire: 245/70R17.5}")
    packed = pack(load_vehicle(write(text, "low.yaml")))
    heights = {"steer_left": (22.5, 0.8 * 0.315), "trailer_1_left_outer": (17.5, 0.7 * 0.245)}
    shares = []
    for tire, (rim_in, height_m) in heights.items():
        seat = 0.5 * rim_in * 0.0254
        for key in ("rim_radius_m", "rim_contact_radius_m", "flat_radius_m"):
            assert seat < packed[f"tire.{tire}.{key}"] < seat + height_m
        shares.append([(packed[f"tire.{tire}.{key}"] - seat) / height_m
                       for key in ("rim_radius_m", "rim_contact_radius_m")])
        shares[-1].append(packed[f"tire.{tire}.rim_span_m"] / height_m)
        shares[-1].append(packed[f"tire.{tire}.flat_radius_m"] / (seat + height_m))
    assert shares[0] == pytest.approx(shares[1])


def test_a_flat_small_trailer_tire_turns_faster(write: Callable[..., Path]) -> None:
    """Its rolling radius falls: with the front tire's belt it grew beyond its free radius."""
    text = TRACTOR_TRAILER.replace("cg_x_m: 6.64}", "cg_x_m: 6.64, tire: 245/70R19.5}")
    vehicle = load_vehicle(write(text, "small.yaml"))
    run = Truck(vehicle, initial=InitialState(speed_mps=20.0))
    before = run.outputs()["hub_speed_trailer_1_left_radps"]
    for dual in ("outer", "inner"):
        run.blow(f"trailer_1_left_{dual}")
    run.advance(Inputs(throttle=0.3), 2500)
    out = run.outputs()
    rolls = out["hub_speed_trailer_1_left_radps"] / out["tractor_vx_mps"]
    assert 1.0 < rolls / (before / 20.0) < 1.1


def test_an_axle_of_the_front_size_needs_no_rim_of_its_own(truck: Vehicle) -> None:
    assert all(spec.rim is None for spec in truck.tire_specs.values())
