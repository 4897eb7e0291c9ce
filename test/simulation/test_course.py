"""A truck that branches off a course late is, bit for bit, the truck that was driven whole."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from truck_blowout_sim.diagnosis.effects import LIBRARY, Effect
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.simulation.course import Course, drive_course, left_abreast
from truck_blowout_sim.simulation.drive import Drive, run_drive
from truck_blowout_sim.simulation.equilibrium import InitialState
from truck_blowout_sim.vehicle import Packed, load_vehicle, pack

STEP_S, LENGTH_S, AT_S = 0.005, 6.0, 3.3
TIMED = [effect for effect in LIBRARY if effect.timed]


@pytest.fixture(scope="module")
def truck() -> Packed:
    return pack(load_vehicle("international_9400i_trailmobile"))


def a_drive(*, speed_imposed: bool = False) -> Drive:
    """A turn, then braking; a tire blown at 2 s."""
    t = STEP_S * np.arange(round(LENGTH_S / STEP_S))
    inputs = np.zeros((t.size, 5))
    inputs[:, 0] = np.sin(2.0 * t)
    inputs[:, 1] = 0.2 * (t < 4.0)
    inputs[:, 2:] = 1e5 * (t > 4.5)[:, None]
    speed = 20.0 - 0.3 * t if speed_imposed else np.zeros(0)
    return Drive(InitialState(speed_mps=20.0), STEP_S, 2, inputs, speed, np.array([400]),
                 np.array([0]))


@pytest.fixture(scope="module")
def course(truck: Packed) -> Course:
    return drive_course(truck, a_drive())


def test_a_course_is_the_drive(truck: Packed, course: Course) -> None:
    np.testing.assert_array_equal(course.out, run_drive(truck, course.drive))


@pytest.mark.parametrize("effect", TIMED, ids=lambda e: f"{e.name} {e.timing} {e.variant}")
def test_every_timed_effect_branches_off_with_the_same_bits(
    truck: Packed, course: Course, effect: Effect
) -> None:
    amount = effect.neutral(truck) + 2.0 * effect.amount.step
    span = (AT_S, effect.end_s(AT_S, 1.0))
    for place in effect.places(truck.vehicle)[-2:]:
        late = Hypothesis(effect, place, amount, {"r": span}).apply(truck, "r")
        whole = run_drive(late, course.drive)
        np.testing.assert_array_equal(course.left_at(late, AT_S), whole)
        assert not np.array_equal(whole, course.out, equal_nan=True)


@pytest.mark.parametrize("since_s", [-1.0, 0.0, 0.5, 2.9999, 5.99, 99.0])
def test_whenever_it_is_left(truck: Packed, course: Course, since_s: float) -> None:
    np.testing.assert_array_equal(course.left_at(truck, since_s), course.out)


def test_an_imposed_speed_goes_on(truck: Packed) -> None:
    course = drive_course(truck, a_drive(speed_imposed=True))
    late = truck.with_values({"unit.trailer.probe_fy_n": 3e3, "unit.trailer.probe_start_s": AT_S,
                              "unit.trailer.probe_end_s": 9.0})
    np.testing.assert_array_equal(course.left_at(late, AT_S), run_drive(late, course.drive))


def test_a_failure_ends_in_nan_as_it_would(truck: Packed, course: Course) -> None:
    lost = truck.unchecked({"unit.tractor.probe_fx_n": np.nan,
                              "unit.tractor.probe_start_s": AT_S,
                              "unit.tractor.probe_end_s": 9.0})
    found = course.left_at(lost, AT_S)
    np.testing.assert_array_equal(found, run_drive(lost, course.drive))
    assert np.isnan(found[-1]).any()


def test_eight_leave_their_courses_abreast(truck: Packed, course: Course) -> None:
    """Of two drives, one shorter, each truck disturbed at an instant of its own."""
    shorter = drive_course(truck, replace(a_drive(), inputs=a_drive().inputs[:900]))
    late = [truck.with_values({"unit.trailer.probe_fy_n": 3e3,
                               "unit.trailer.probe_start_s": AT_S + 0.15 * k,
                               "unit.trailer.probe_end_s": 9.0}) for k in range(7)]
    courses = [shorter if k % 3 == 1 else course for k in range(7)]
    assert len({c.kind_of(t) for c, t in zip(courses, late, strict=True)}) == 1
    found = left_abreast(courses, late, AT_S)
    assert [len(rows) for rows in left_abreast(courses, late, np.inf)] == [
        len(of_course.out) for of_course in courses]
    for k, (one, of_course, each) in enumerate(zip(late, courses, found, strict=True)):
        alone = of_course.left_at(one, AT_S + 0.15 * k)
        np.testing.assert_allclose(each, alone, rtol=1e-6, atol=1e-6 * np.nanmax(abs(alone)))
        assert each.shape == of_course.out.shape


def test_a_truck_that_fails_abreast_stops_no_other(truck: Packed, course: Course) -> None:
    lost = truck.unchecked({"unit.tractor.probe_fx_n": np.nan, "unit.tractor.probe_start_s": AT_S,
                            "unit.tractor.probe_end_s": 9.0})
    found, failed = left_abreast([course] * 2, [truck, lost], AT_S)
    np.testing.assert_allclose(found, course.out, rtol=1e-6, atol=1e-6 * np.nanmax(abs(found)))
    np.testing.assert_array_equal(np.isnan(failed), np.isnan(course.left_at(lost, AT_S)))


def test_a_course_that_failed_goes_alone(truck: Packed, course: Course) -> None:
    lost = truck.unchecked({"unit.tractor.probe_fx_n": np.nan, "unit.tractor.probe_start_s": 1.0,
                            "unit.tractor.probe_end_s": 9.0})
    failed = drive_course(lost, a_drive())
    assert failed.kind_of(truck) != failed.kind_of(truck) != course.kind_of(truck)
    assert course.kind_of(truck) == course.kind_of(truck)


def test_a_driver_is_refused(truck: Packed) -> None:
    with pytest.raises(ValueError, match="driver"):
        drive_course(truck, replace(a_drive(), pilot=np.zeros(17)))
