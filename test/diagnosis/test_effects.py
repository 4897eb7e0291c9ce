"""The library: names, neutrality, bounds, words, and that every effect acts."""

from __future__ import annotations

import string

import numpy as np
import pytest
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.answer.words import fill
from truck_blowout_sim.diagnosis.effects import LIBRARY, Effect
from truck_blowout_sim.diagnosis.effects.base import GripUsed
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.result.parts import Place
from truck_blowout_sim.diagnosis.settings import load_settings
from truck_blowout_sim.resources import config_names
from truck_blowout_sim.simulation import InitialState, Inputs, Truck
from truck_blowout_sim.vehicle import Packed, load_vehicle, pack

Floats = NDArray[np.float64]

PHYSICS = {
    "blown_tire_drag", "blown_tire_cornering", "slow_deflation", "secondary_blowout",
    "steering_compliance", "steering_lash", "roll_steer", "tire_relaxation", "tire_saturation",
    "friction_change", "crosswind", "aerodynamic_drag", "road_grade", "road_bank",
    "driveline_drag", "brake_lag", "brake_imbalance", "brake_fade", "axle_misalignment",
    "payload_shift", "fifth_wheel_friction", "steering_lag", "steering_ratio",
}  # fmt: skip
EVERY = [pytest.param(effect, id=effect.name) for effect in LIBRARY]
OF_TRUCKS = [effect for effect in LIBRARY
             if effect.amount.name != "inverse_peak_friction" and not effect.variant]


def hypotheses(effect: Effect, packed: Packed) -> list[Hypothesis]:
    times = {"run": (2.0, 4.0)} if effect.timed else {}
    return [Hypothesis(effect, place, effect.neutral(packed), times)
            for place in effect.places(packed.vehicle)]


def test_names_are_the_canonical_ones() -> None:
    names = [effect.name for effect in OF_TRUCKS]
    assert len(names) == len(set(names))
    assert {e.name for e in LIBRARY if e.kind == "physics" and e.listed} == PHYSICS
    assert {e.name for e in LIBRARY if not e.listed} == {
        "wheel_drag", "corner_drag", "yaw_moment"}
    assert {e.name for e in LIBRARY if e.kind == "sensor"} == {
        "steering_angle_offset", "yaw_rate_scale"}


@pytest.mark.parametrize("effect", EVERY)
@pytest.mark.parametrize("vehicle", config_names("vehicles"))
def test_what_a_search_may_find_is_no_value_that_a_vehicle_file_refuses(
    effect: Effect, vehicle: str
) -> None:
    packed = pack(load_vehicle(vehicle))
    for h in hypotheses(effect, packed):
        lowest, highest = (packed.with_values(effect.values(packed, h.place, amount))
                           for amount in (effect.amount.low, effect.amount.high))
        assert not np.array_equal(lowest.params, highest.params), str(h.place)


@pytest.mark.parametrize("effect", EVERY)
@pytest.mark.parametrize("vehicle", config_names("vehicles"))
def test_the_neutral_amount_changes_no_parameter(effect: Effect, vehicle: str) -> None:
    packed = pack(load_vehicle(vehicle))
    for h in hypotheses(effect, packed):
        values = dict(effect.values(packed, h.place, h.amount))
        if effect.name == "steering_compliance" and not packed["steering.compliance_on"]:
            del values["steering.stiffness_gain"]  # of a compliance that is off: nobody reads it
        if effect.name == "secondary_blowout":  # what is neutral there is having no instant
            assert h.apply(packed, "another run", 1.0) is packed
            continue
        assert {n: packed[n] for n in values} == pytest.approx(values), str(h.place)


@pytest.mark.parametrize("vehicle", config_names("vehicles"))
def test_no_axle_has_a_name_twice(vehicle: str) -> None:
    loaded = load_vehicle(vehicle)
    keys = [(effect.name, str(place), effect.sentence)
            for effect in LIBRARY for place in effect.places(loaded)]
    assert len(keys) == len(set(keys))


@pytest.mark.parametrize("effect", OF_TRUCKS, ids=lambda effect: effect.name)
def test_a_step_changes_the_truck_at_every_place_and_in_no_other_run(
    effect: Effect, truck: Packed
) -> None:
    assert effect.places(truck.vehicle)
    seen = []
    for h in hypotheses(effect, truck):
        moved = h.apply(truck, "run", h.amount + effect.amount.step)
        changed = np.flatnonzero(moved.params != truck.params)
        assert changed.size, str(h.place)
        seen.append(tuple(changed))
        if effect.timed:
            assert h.apply(truck, "other run", 1.0) is truck
    assert len(set(seen)) == len(seen), "two places mean the same parameters"


@pytest.mark.parametrize("effect", EVERY)
def test_bounds_hold_the_neutral_amount_the_step_and_every_start(
    effect: Effect, truck: Packed
) -> None:
    amount = effect.amount
    neutral = effect.neutral(truck)
    low = min(amount.low, 0.0) if effect.name == "secondary_blowout" else amount.low
    assert low <= neutral <= amount.high
    assert low <= neutral + amount.step <= amount.high
    assert all(amount.low <= start <= amount.high for start in amount.grid)
    assert 0.0 < amount.material < amount.high - amount.low
    ends = [amount.report(a) for a in np.linspace(amount.low, amount.high, 9)]
    assert (np.diff(ends) > 0).all() or (np.diff(ends) < 0).all(), "what is reported must be unique"


@pytest.mark.parametrize("effect", [one for one in LIBRARY if one.amount.grid],
                         ids=lambda e: f"{e.name}{e.variant}")
def test_the_starts_of_a_search_reach_the_far_ends_of_what_is_possible(effect: Effect) -> None:
    # from a far smaller amount the descent stops: between lie trucks that skid or do not
    amount = effect.amount
    starts = [*amount.grid, amount.step]
    assert max(starts) >= amount.high / 4.0 or amount.high <= 4.0 * abs(amount.step)
    assert min(starts) <= amount.low / 4.0 or amount.low >= -4.0 * abs(amount.step)


@pytest.mark.parametrize("effect", EVERY)
def test_words_fill_for_every_place(effect: Effect, truck: Packed) -> None:
    fields = {f for text in (effect.sentence, effect.equation)
              for _, f, _, _ in string.Formatter().parse(text) if f}
    assert fields <= {"where", "axles", "value", "percent", "percent_of", "onset"}
    assert effect.timing == "always" or "onset" in fields
    for h in hypotheses(effect, truck):
        sentence, equation = fill(h, 0.1234, 2.5 if effect.timed else None)
        assert sentence.endswith(".")
        assert not set("{}") & set(sentence + equation)
        assert "axle truck" not in sentence
        assert not effect.timed or "2.5" in sentence
    assert effect.splits


@pytest.mark.parametrize("effect", EVERY)
def test_only_effects_with_an_onset_have_instants(effect: Effect, truck: Packed) -> None:
    assert (effect.timed is None) == (effect.timing == "always")
    if effect.timed is None:
        return
    for place in effect.places(truck.vehicle):
        early = effect.timed(truck, place, 1.0, 3.0)
        late = effect.timed(truck, place, 2.0, 4.0)
        assert set(early) <= set(truck.index)
        assert any(late[n] == early[n] + 1.0 for n in early)


@pytest.mark.parametrize("effect", EVERY)
def test_what_single_vehicles_stray_by_is_above_zero_and_says_where_it_is_from(
    effect: Effect
) -> None:
    assert 0.0 < effect.amount.material < max(effect.amount.high, -effect.amount.low)
    assert len(effect.amount.source.split()) > 3


@pytest.mark.parametrize("effect", EVERY)
def test_what_a_nuisance_imitates_is_a_nuisance(effect: Effect, truck: Packed) -> None:
    known = {n.name for n in load_settings(truck).nuisances}
    meanings = {h.meaning(truck.vehicle) for h in hypotheses(effect, truck)}
    assert meanings <= known | {"", "roll_steer_", "toe_"}, meanings - known


def test_places_name_body_axle_hub_and_tire(truck: Packed) -> None:
    by_name = {effect.name: effect for effect in LIBRARY}
    tire = by_name["blown_tire_drag"].places(truck.vehicle)
    assert {p.tire for p in tire} == set(truck.vehicle.tires)
    assert all(p.tire in truck.vehicle.tires_of_hub(p.hub or "") for p in tire)
    assert {p.hub for p in by_name["brake_imbalance"].places(truck.vehicle)} == set(
        truck.vehicle.hubs)
    assert by_name["payload_shift"].places(truck.vehicle) == (Place(body="trailer"),)
    assert "steer" not in {p.axle for p in by_name["axle_misalignment"].places(truck.vehicle)}


def test_a_vehicle_without_trailer_has_no_fifth_wheel() -> None:
    for name in config_names("vehicles"):
        vehicle = load_vehicle(name)
        effect = next(e for e in LIBRARY if e.name == "fifth_wheel_friction")
        assert len(effect.places(vehicle)) == (len(vehicle.units) == 2)


def test_saturation_is_asked_of_all_axles_that_share_a_tire() -> None:
    """A car on four tires of one type: what is wrong of the type is wrong of each."""
    effect = next(e for e in LIBRARY if e.name == "tire_saturation" and not e.variant)
    alike = pack(load_vehicle("bmw_320i"))
    assert Place() in effect.places(alike.vehicle)
    both = effect.values(alike, Place(), -0.25)
    assert both == {f"axle.{axle}.peak_scale": 0.75 for axle in alike.vehicle.axles}
    mixed = load_vehicle("international_9400i_trailmobile")
    assert Place() not in effect.places(mixed)


def _magic_formula(slip: Floats, peak: float) -> Floats:
    """Side force of unit cornering stiffness, in the form of the shipped truck tires."""
    shape, curvature = 1.45, 0.2
    x = slip / (shape * peak)
    return peak * np.sin(shape * np.arctan(x - curvature * (x - np.arctan(x))))


def _brush(slip: Floats) -> Floats:
    """The same stiffness, peak 1, of a brush tire (Pacejka 2012, eq. 3.8)."""
    third = np.minimum(slip / 3.0, 1.0)
    return 3.0 * third - 3.0 * third**2 + third**3


@pytest.mark.parametrize("name", ["tire_saturation", "friction_change"])
@pytest.mark.parametrize("largest_slip", [0.35, 0.5, 0.8, 1.2])
def test_a_tire_of_another_form_looks_like_one_of_a_lower_peak(largest_slip: float, name: str
                                                               ) -> None:
    """As the effect assumes: by 0.7 of what the runs leave to the limit of grip."""
    slip = np.linspace(0.0, largest_slip, 60)
    peaks = np.linspace(0.3, 1.2, 901)
    misfit = [float(np.sum((_magic_formula(slip, peak) - _brush(slip)) ** 2)) for peak in peaks]
    seems_lower = 1.0 - peaks[int(np.argmin(misfit))]
    used = float(_brush(slip)[-1])
    effect = next(e for e in LIBRARY if e.name == name and not e.variant)
    assert seems_lower == pytest.approx(2.0 * effect.far_from_limit * (1.0 - used), abs=0.06)


def test_what_acts_near_the_limit_strays_more_far_from_it(truck: Packed) -> None:
    effect = next(e for e in LIBRARY if e.name == "tire_saturation" and not e.variant)
    sizes = [effect.strays(truck, GripUsed(used, 1.0))[0] for used in (1.0, 0.9, 0.5, 0.2)]
    assert sizes == sorted(sizes)
    assert sizes[0] == pytest.approx(0.5 * effect.amount.material)


def test_braking_hard_shows_friction_but_no_side_force(truck: Packed) -> None:
    braked = GripUsed(0.1, 1.0)
    friction, peak = (next(e for e in LIBRARY if e.name == name and not e.variant)
                      for name in ("friction_change", "tire_saturation"))
    assert friction.strays(truck, braked) == friction.strays(truck)
    assert peak.strays(truck, braked) > peak.strays(truck)


def test_a_wrong_sheet_does_not_widen_what_forms_differ_by(truck: Packed) -> None:
    effect = next(e for e in LIBRARY if e.name == "tire_saturation" and not e.variant)
    trucks = 0.5 * effect.amount.material
    for used in (1.0, 0.5, 0.0):
        forms = effect.far_from_limit * (1.0 - used) + effect.near_limit * used
        usual, wrong = effect.strays(truck, GripUsed(used, 1.0))
        assert usual**2 == pytest.approx(trucks**2 + forms**2)
        assert wrong**2 == pytest.approx((4.0 * trucks) ** 2 + forms**2)


@pytest.mark.parametrize("name", ["blown_tire_drag", "blown_tire_cornering"])
def test_a_wrong_sheet_does_not_widen_what_all_published_flat_tires_differ_by(
        name: str, truck: Packed) -> None:
    """A flat that drags four times as much is no entry of a file that is wrong."""
    effect = next(e for e in LIBRARY if e.name == name and not e.variant)
    assert effect.absorbs
    assert effect.strays(truck) == (0.5 * effect.amount.material,)


def _spread_of_slips(used: float) -> float:
    """1 sigma between four forms of equal slope and peak, at a share of the peak."""
    forms = (_brush, np.tanh, lambda slip: np.sin(1.3 * np.arctan(slip / 1.3)),
             lambda slip: np.where(slip < 0.5, slip, 1.0 - 0.25 / np.maximum(slip, 0.5)))
    slip = np.linspace(0.0, 3.0, 3001)
    return float(np.std([np.interp(used, form(slip)[:2001], slip[:2001]) for form in forms]))


@pytest.mark.parametrize("used", [0.3, 0.4, 0.5, 0.6, 0.8])
def test_a_tire_of_another_form_looks_like_a_roll_steer(used: float) -> None:
    """As the effect assumes, with 6/rad of slope over load and 0.1 rad/g of roll."""
    effect = next(e for e in LIBRARY if e.name == "roll_steer")
    seems = _spread_of_slips(used) / (6.0 * 0.1 * used)
    assert seems == pytest.approx(effect.near_limit * used, abs=0.05)


def test_tires_of_every_axle_alike_are_those_of_all_axles() -> None:
    car = pack(load_vehicle("bmw_320i"))
    effect = next(e for e in OF_TRUCKS if e.name == "tire_saturation"
                  and any(not p.axle for p in e.places(car.vehicle)))
    place = next(p for p in effect.places(car.vehicle) if not p.axle)
    sentence, _ = fill(Hypothesis(effect, place), 0.8, None)
    assert sentence.startswith("The tires of all axles give out earlier")


def test_a_load_that_moves_to_the_left_turns_the_body_to_the_left(truck: Packed) -> None:
    """Its weight points down: about x, which points forward, the moment is negative."""
    effect = next(e for e in LIBRARY if e.name == "payload_shift")
    _, equation = fill(Hypothesis(effect, effect.places(truck.vehicle)[0]), 0.4, 2.5)
    assert equation.startswith("M_x = -m_load g * 0.4 m from t = 2.50 s")


def chamber_pa(packed: Packed) -> Floats:
    """[2000] pressure in a trailer's brake chamber, each ms after 1 bar: no wheel locks."""
    run, found = Truck(packed, initial=InitialState(speed_mps=20.0)), np.zeros(2000)
    for k in range(found.size):
        run.advance(Inputs(0.0, 0.0, 1e5, 1e5, 1e5))
        found[k] = run.outputs()["brake_chamber_trailer_2_left_pa"]
    return found


def test_late_brakes_are_as_late_as_they_say_and_begin_late_by_law(truck: Packed) -> None:
    """The area between control and chamber pressure is the lag, however it comes about."""
    laws = [effect for effect in LIBRARY if effect.name == "brake_lag"]
    sound, place = chamber_pa(truck), Place(body="trailer", axle="trailer")
    begins = []
    for law in laws:
        late = chamber_pa(truck.with_values(law.values(truck, place, 0.2)))
        assert 0.001 * float(np.sum(sound - late)) / 1e5 == pytest.approx(0.2, abs=0.004)
        begins.append(0.001 * int(np.argmax(late > 0.0) - np.argmax(sound > 0.0)))
    assert begins == pytest.approx([0.0, 0.2, 0.1], abs=0.003)
