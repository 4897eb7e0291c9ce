"""Inputs: ranges, NaN, timeouts, safe values, ages; first alone, then in the node."""

# ruff: noqa: ANN401 (fixtures and messages come from rclpy, which has no types for them)
from __future__ import annotations

import math
from typing import Any

import pytest
from diagnostic_msgs.msg import DiagnosticArray
from std_msgs.msg import Float64

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.nodes.inputs import Input, InputBank
from truck_blowout_sim.nodes.simulator_parameters import SPECS, inputs_of

S = 1_000_000_000


@pytest.fixture
def throttle() -> Input:
    return Input("throttle", "throttle", 0.0, 1.0, timeout_s=0.5, safe_value=0.1)


def test_safe_value_applies_before_the_first_message(throttle: Input) -> None:
    assert throttle.applied(5 * S) == 0.1
    assert throttle.age_s(5 * S) == math.inf
    assert not throttle.timed_out


def test_good_value_holds_until_its_timeout(throttle: Input) -> None:
    assert throttle.offer(0.7, 0) == ""
    assert throttle.applied(S // 2) == 0.7
    assert throttle.applied(S // 2 + 1) == 0.1
    assert throttle.timed_out


def test_a_new_message_ends_a_timeout(throttle: Input) -> None:
    throttle.offer(0.7, 0)
    throttle.applied(S)
    throttle.offer(0.4, S)
    assert throttle.applied(S) == 0.4
    assert not throttle.timed_out


def test_timeout_zero_holds_for_ever() -> None:
    one = Input("throttle", "throttle", 0.0, 1.0, timeout_s=0.0, safe_value=0.0)
    one.offer(0.7, 0)
    assert one.applied(10_000 * S) == 0.7


@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf, -0.01, 1.01])
def test_bad_values_are_refused_and_the_last_good_one_holds(throttle: Input, bad: float) -> None:
    throttle.offer(0.7, 0)
    assert "refused, expected 0 to 1" in throttle.offer(bad, S // 4)
    assert throttle.applied(S // 4) == 0.7
    assert throttle.refused == 1
    # and it is no sign of life
    assert throttle.applied(S) == 0.1


@pytest.fixture(scope="module")
def simulator(start: Any) -> Any:
    node = start(
        "simulator", "--input-timeout-s", 0.5, "--inputs.throttle.safe-value", 0.05,
        "--diagnostics-rate-hz", 10,
    )  # fmt: skip
    node.wait_for("ready")
    return node


class Inputs:
    """The status "inputs" of the diagnostics."""

    def __init__(self, client: Any) -> None:
        self.client = client
        self.heard = client.listen(DiagnosticArray, "/diagnostics")

    def until(self, done: Any, act: Any = lambda: None) -> dict[str, str]:
        """Act once a report until one says so; that report."""
        for _ in range(100):
            if done(state := self.now()):
                return state
            act()
        raise AssertionError(f"never so: {state}")

    def now(self) -> dict[str, str]:
        seen = len(self.heard)
        self.client.until(lambda: len(self.heard) > seen + 1, what="diagnostics")
        status = next(s for s in self.heard[-1].status if s.name.endswith("inputs"))
        return {pair.key: pair.value for pair in status.values} | {"message": status.message}


def test_node_refuses_warns_once_and_holds(simulator: Any, client: Any) -> None:
    inputs = Inputs(client)
    throttle = client.talk(Float64, "/truck/throttle")
    throttle.publish(Float64(data=0.4))
    for bad in (math.nan, 2.0, -1.0, math.inf):
        throttle.publish(Float64(data=bad))
    inputs.until(lambda state: state["throttle refused"] == "4")
    simulator.wait_for("not a number refused")
    assert simulator.output.count("refused") == 1
    throttle.publish(Float64(data=0.4))
    client.spin(0.15)
    assert float(inputs.now()["throttle applied"]) in (0.4, 0.05)


def test_node_applies_the_safe_value_after_the_timeout(simulator: Any, client: Any) -> None:
    inputs = Inputs(client)
    throttle = client.talk(Float64, "/truck/throttle")
    alive = inputs.until(
        lambda state: float(state["throttle applied"]) == 0.6,
        lambda: throttle.publish(Float64(data=0.6)),
    )
    assert float(alive["throttle age_s"]) < 0.51
    late = inputs.until(lambda state: "timed out" in state["message"])
    assert float(late["throttle applied"]) == 0.05
    assert "timed out" in late["message"]
    assert "throttle" in late["message"]
    assert float(late["throttle age_s"]) > 0.5
    assert late["steering_wheel_angle age_s"] == "never"


def test_pressures_are_bounded_by_the_kind_of_brakes() -> None:
    values: dict[str, Any] = {spec.name: spec.default for spec in SPECS}
    highest = {kind: inputs_of(values, kind)[-1].high for kind in ("air", "hydraulic")}
    assert highest == {"air": 1.0e6, "hydraulic": 2.5e7}
    stated = values | {"inputs.brake_pressure_trailer_pa.max": 5.0e5}
    assert inputs_of(stated, "hydraulic")[-1].high == 5.0e5


@pytest.mark.parametrize("name", ["throttle", "steering_wheel_angle_rad"])
def test_a_greatest_value_of_zero_is_zero_where_it_is_no_pressure(name: str) -> None:
    values: dict[str, Any] = {spec.name: spec.default for spec in SPECS}
    (one,) = (i for i in inputs_of(values | {f"inputs.{name}.max": 0.0}) if i.name == name)
    assert "refused" in one.offer(0.01, 0)
    assert one.offer(0.0, 0) == ""


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"throttle.min": 0.8, "throttle.max": 0.2}, r"inputs\.throttle\.min: 0\.8 lies above max"),
        ({"throttle.max": 0.5, "throttle.safe_value": 0.7}, "expected min to max, 0 to 0.5"),
        ({"steering_wheel_angle_rad.min": 1.0}, "safe_value: 0 is out of range"),
        ({"brake_pressure_drive_pa.safe_value": 2.0e6}, "0 to 1e"),
    ],
)
def test_a_range_that_excludes_what_applies_is_refused(given: dict[str, float], said: str) -> None:
    values: dict[str, Any] = {spec.name: spec.default for spec in SPECS}
    with pytest.raises(InputError, match=said):
        inputs_of(values | {f"inputs.{key}": value for key, value in given.items()})


def test_a_jump_of_time_ages_no_message(throttle: Input) -> None:
    bank = InputBank([throttle])
    throttle.offer(0.7, 5 * S)
    bank.shift(100 * S)
    assert bank.applied(105 * S) == (0.7,)
    assert throttle.age_s(105 * S + S // 4) == 0.25
