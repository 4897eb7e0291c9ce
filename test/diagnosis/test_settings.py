"""What is assumed, read from a file: refusals, wildcards, and that each assumption acts."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
import yaml

from truck_blowout_sim.diagnosis.result import Calibrated
from truck_blowout_sim.diagnosis.settings import STATED, Settings, load_settings
from truck_blowout_sim.diagnosis.settings_file import settings_tree
from truck_blowout_sim.errors import InputError
from truck_blowout_sim.report.diagnosis_rows import calibrated_row
from truck_blowout_sim.resources import config_file, config_names
from truck_blowout_sim.vehicle import Packed, load_vehicle, pack
from truck_blowout_sim.vehicle.packing import packed_spreads

Edit = Callable[[dict], None]


@pytest.fixture
def refusal(tmp_path: Path, truck: Packed) -> Callable[[Edit], str]:
    """The line with which the default file is refused after an edit."""

    def refuse(edit: Edit) -> str:
        tree = yaml.safe_load(config_file("diagnosis", "default").read_text(encoding="utf-8"))
        edit(tree)
        path = tmp_path / "mine.yaml"
        path.write_text(yaml.safe_dump(tree), encoding="utf-8")
        with pytest.raises(InputError) as caught:
            load_settings(truck, str(path))
        line = str(caught.value)
        assert line.startswith(str(path)), line
        assert "\n" not in line
        return line

    return refuse


def test_an_unknown_key_is_refused_with_its_place(refusal: Callable[[Edit], str]) -> None:
    assert "sheet.drag_area" in (
        line := refusal(lambda tree: tree["sheet"]["drag_area"].update(sigmas=1.0)))
    assert "'sigmas'" in line
    assert "expected one of" in line
    assert "channels._vx_mps" in refusal(lambda tree: tree["channels"]["_vx_mps"].update(flor=1.0))
    assert "'bin_seconds'" in refusal(
        lambda tree: tree["method"].update(bin_seconds={"value": 1.0}))
    assert "'metod'" in refusal(lambda tree: tree.update(metod={}))


def test_a_missing_key_is_refused_with_its_name(refusal: Callable[[Edit], str]) -> None:
    assert "'for'" in refusal(lambda tree: tree["sheet"]["drag_area"].pop("for"))
    assert "'bin_s'" in refusal(lambda tree: tree["method"].pop("bin_s"))
    assert "'channels'" in refusal(lambda tree: tree.pop("channels"))
    assert "'floor'" in refusal(lambda tree: tree["channels"]["_vx_mps"].pop("floor"))


def test_words_where_numbers_belong_are_refused(refusal: Callable[[Edit], str]) -> None:
    assert "'much'" in refusal(
        lambda tree: tree["sheet"]["drag_area"]["for"].update(truck="much"))
    assert "'multiply'" in refusal(
        lambda tree: tree["sheet"]["drag_area"].update(kind="multiply"))
    assert "'long'" in refusal(lambda tree: tree["method"]["bin_s"].update(value="long"))


def test_a_name_that_is_not_shipped_says_which_are(truck: Packed) -> None:
    with pytest.raises(InputError, match="default"):
        load_settings(truck, "nowhere")


@pytest.mark.parametrize("name", config_names("diagnosis"))
@pytest.mark.parametrize("vehicle", config_names("vehicles"))
def test_every_number_has_a_source_and_every_target_exists(name: str, vehicle: str) -> None:
    tree = settings_tree(config_file("diagnosis", name))
    entries = [*tree["sheet"].values(), *tree["channels"].values(), *tree["method"].values(),
               *tree.get("forms", {}).values()]
    assert all(entry["source"] for entry in entries)
    names = [n.name for n in load_settings(pack(load_vehicle(vehicle)), name).nuisances]
    assert len(names) == len(set(names))


def test_a_role_is_refused_that_no_vehicle_can_have(refusal: Callable[[Edit], str]) -> None:
    line = refusal(lambda tree: tree["sheet"]["toe"]["for"].update(floating=0.1))
    assert "sheet.toe.for" in line
    assert "'floating'" in line
    assert "towed" in line


def test_a_number_that_a_part_lacks_is_refused_by_name(refusal: Callable[[Edit], str]) -> None:
    line = refusal(lambda tree: tree["sheet"]["toe"].update(targets=["axle.<axle>.toe_deg"]))
    assert "sheet.toe" in line
    assert "axle.drive_1.toe_deg" in line


@pytest.mark.parametrize("vehicle", ["ferrari_250lm", "rigid_truck", "bmw_320i"])
def test_every_axle_of_any_vehicle_has_numbers_of_its_own(vehicle: str) -> None:
    packed = pack(load_vehicle(vehicle))
    moved = {target for n in load_settings(packed).nuisances for target, _ in n.targets}
    for tire in packed.vehicle.tires:
        assert f"tire.{tire}.cornering_scale" in moved
    for hub in packed.vehicle.hubs:
        assert f"hub.{hub}.brake_gain" in moved
    for unit in packed.vehicle.units:
        assert f"unit.{unit}.mass_kg" in moved
    assert "fifth_wheel.yaw_friction_nm" not in moved


def test_drive_power_is_a_number_only_where_a_rule_of_thumb_stands_for_it(
    ten_line_car: Path, truck: Packed
) -> None:
    found = {n.name: n for n in load_settings(pack(load_vehicle(ten_line_car))).nuisances}
    assert found["drive_power"].sigma == pytest.approx(25.0 / 70.0)
    assert "drive_power" not in {n.name for n in load_settings(truck).nuisances}


def test_a_file_takes_over_what_it_does_not_say(tmp_path: Path, truck: Packed) -> None:
    path = tmp_path / "mine.yaml"
    path.write_text("extends: default\nwithout: [caster]\n"
                    "sheet: {mass: {for: {towing_unit: 0.5}, source: guessed}}\n"
                    "method: {bin_s: {value: 0.2, source: coarse}}\n")
    mine, usual = load_settings(truck, str(path)), load_settings(truck)
    sigma = {n.name: n.sigma for n in mine.nuisances}
    assert sigma["tractor_mass"] == 0.5
    assert "caster" not in sigma
    assert "trailer_mass" not in sigma, "the roles are those said here"
    assert set(sigma) == {n.name for n in usual.nuisances} - {"caster", "trailer_mass"}
    assert (mine.bin_s, mine.skip_s) == (0.2, usual.skip_s)
    assert mine.channels == usual.channels


def test_taking_over_what_the_other_file_lacks_is_refused(tmp_path: Path, truck: Packed) -> None:
    path = tmp_path / "mine.yaml"
    for said in ("sheet: {weight: {}}", "without: [weight]", "method: {weight: {value: 1}}"):
        path.write_text(f"extends: default\n{said}\n")
        with pytest.raises(InputError, match="'weight'"):
            load_settings(truck, str(path))


def test_every_nuisance_moves_its_targets_by_its_amount(truck: Packed) -> None:
    settings = load_settings(truck)
    for n in settings.nuisances:
        assert n.sigma > 0.0
        for (target, sign), value in zip(n.targets, n.values(truck, 0.1).values(), strict=True):
            moved = truck[target] * (1 + sign * 0.1) if n.kind == "scale" else (
                truck[target] + sign * 0.1)
            assert value == pytest.approx(moved)
        assert dict(n.values(truck, 0.0)) == {t: truck[t] for t, _ in n.targets}


def test_each_hub_brake_is_a_nuisance_seen_under_braking_only(truck: Packed) -> None:
    settings = load_settings(truck)
    brakes = [n for n in settings.nuisances if n.name.startswith("brake_gain_")]
    assert {n.name.removeprefix("brake_gain_") for n in brakes} == set(truck.vehicle.hubs)
    assert {n.only for n in brakes} == {"brakes"}


def test_raising_the_center_of_gravity_lowers_what_is_attached_to_the_body(truck: Packed) -> None:
    settings = load_settings(truck)
    raised = next(n for n in settings.nuisances if n.name == "trailer_cg_height")
    values = raised.values(truck, 0.1)
    grown = {n for n, v in values.items() if v > truck[n]}
    assert grown == {"unit.trailer.cg_height_m"}
    assert "unit.trailer.hitch_z_m" in set(values) - grown


def test_a_channel_finds_its_rule_by_end_or_by_beginning(few: Settings) -> None:
    assert few.rule("tractor_yaw_rate_radps") is few.channels["_yaw_rate_radps"]
    assert few.rule("trailer_yaw_rate_radps") is few.channels["trailer_yaw_rate_radps"]
    assert few.rule("hub_speed_drive_1_left_radps") is few.channels["hub_speed_"]
    assert few.rule("tractor_x_m") is None
    assert few.rule("steering_wheel_angle_rad") is None


def test_a_misspelt_effect_is_refused(refusal: Callable[[Edit], str]) -> None:
    line = refusal(lambda tree: tree["forms"].update(croswind={"share": 0.1}))
    assert "forms: unknown key 'croswind'; expected one of" in line


def test_a_track_that_a_rule_of_thumb_states_may_be_another(ten_line_car: Path) -> None:
    """Its middle lies where it did."""
    car = pack(load_vehicle(ten_line_car))
    own = {n.name: n for n in load_settings(car).nuisances}
    wide = own["steered_track"]
    assert wide.source == STATED
    assert 0.02 < wide.sigma < 0.1
    moved = car.unchecked(wide.values(car, wide.sigma))
    for hub in ("front_left", "front_right"):
        assert moved[f"hub.{hub}.y_m"] == pytest.approx((1.0 + wide.sigma) * car[f"hub.{hub}.y_m"])
    assert own["tractor_cg_left"].source != STATED


def test_a_spread_that_the_vehicle_file_states_is_the_prior(tmp_path: Path) -> None:
    """Of all brakes of an axle it is no spread of one against the other."""
    path = tmp_path / "stated.yaml"
    path.write_text(
        "extends: international_9400i_trailmobile\nunits: {tractor: {body: {izz_kgm2: "
        "{value: 20000, spread: 3000, source: swung}}}}\naxles: {steer: {brake: {linear_nmppa: "
        "{value: 0.012, spread: 0.003, source: rolled}}}}\n", encoding="utf-8")  # fmt: skip
    stated = pack(load_vehicle(path))
    usual, mine = ({n.name: n for n in load_settings(truck).nuisances}
                   for truck in (pack(load_vehicle("international_9400i_trailmobile")), stated))
    assert mine["tractor_yaw_inertia"].sigma == pytest.approx(
        3000.0 / stated["unit.tractor.izz_kgm2"])
    assert mine["tractor_yaw_inertia"].source == STATED
    assert mine["steered_lining"].sigma == pytest.approx(0.25)
    assert "steered_track" not in usual
    for name in ("brake_gain_steer_left", "trailer_yaw_inertia", "driven_lining"):
        assert mine[name] == usual[name]
        assert mine[name].source != STATED


def test_a_channel_that_no_recording_has_is_refused(refusal: Callable[[Edit], str]) -> None:
    def misspell(tree: dict) -> None:
        tree["channels"]["_yaw_rate_radpss"] = tree["channels"].pop("_yaw_rate_radps")

    assert "expected _yaw_rate_radps (the nearest)" in refusal(misspell)


@pytest.mark.parametrize(("key", "value"), [("trial_step_s", 1.0), ("bin_s", -0.1),
                                            ("correlation_s", 0.0), ("false_alarms", 2.0)])
def test_a_number_of_the_method_has_bounds(key: str, value: float,
                                           refusal: Callable[[Edit], str]) -> None:
    def change(tree: dict) -> None:
        tree["method"][key]["value"] = value

    line = refusal(change)
    assert f"method.{key}" in line
    assert "expected a number above 0" in line


def test_every_spread_of_a_rule_of_thumb_is_a_prior(tmp_path: Path) -> None:
    path = tmp_path / "ten_lines.yaml"
    path.write_text(
        "single_track:\n  kind: truck\n  mass_kg: 8198\n  wheelbase_m: 5.994\n  cg_x_m: 2.42\n"
        "  yaw_inertia_kgm2: 55000\n  steering_ratio: 22\n  tire: 275/80R22.5\n  rear_axles: 2\n"
        "  hitch_x_m: 5.5\n  trailer: {mass_kg: 15388, wheelbase_m: 11.2265, cg_x_m: 6.64}\n",
        encoding="utf-8")
    truck = pack(load_vehicle(path))
    stated = packed_spreads(truck)
    moved = {name for number in load_settings(truck).nuisances if number.source == STATED
             for name, _ in number.targets}
    assert set(stated) <= moved
    assert len(stated) > 300


def test_every_amount_has_its_unit_and_the_page_shows_it(truck: Packed) -> None:
    numbers = {n.name: n for n in load_settings(truck).nuisances}
    assert numbers["steering_zero"].unit == "rad"
    assert numbers["trailer_mass"].unit == "1"
    zero = Calibrated("steering_zero", numbers["steering_zero"].unit, 0.0, 1.0, 0.5, 0.1)
    share = Calibrated("trailer_mass", "1", 0.0, 0.02, 0.01, 0.01, relative=True)
    assert [calibrated_row(n)["unit"] for n in (zero, share)] == ["rad", "%"]
    for vehicle in config_names("vehicles"):
        for n in load_settings(pack(load_vehicle(vehicle))).nuisances:
            pure = n.kind == "scale" or n.targets[0][0].endswith((".roll_steer", ".polytropic"))
            assert (n.unit == "1") == pure, n.targets[0][0]


def test_all_tests_together_raise_the_one_stated_rate_of_false_alarms(truck: Packed) -> None:
    """Names, instruments, two tests of what is left, four signs; the last two beside a baseline."""
    rules = load_settings(truck)
    alone = rules.alarms_by_name(baseline=False) + rules.alarms_by_instrument
    assert alone == pytest.approx(rules.false_alarms)
    parts = (rules.alarms_by_name(baseline=True), rules.alarms_by_instrument,
             2.0 * rules.alarms_by_rest, 4.0 * rules.alarms_by_sign)
    assert sum(parts) == pytest.approx(rules.false_alarms)
    assert min(parts) > 0.0
