"""A truck that rolled over stops the node with words of its own."""

# ruff: noqa: ANN401 (fixtures come from rclpy, which has no types for them)
from __future__ import annotations

from typing import Any

from diagnostic_msgs.msg import DiagnosticArray
from std_msgs.msg import Float64
from std_srvs.srv import Trigger

from truck_blowout_sim.nodes import diagnostics
from truck_blowout_sim.simulation.ending import NOT_FINITE, ROLLED_OVER, Ending


def test_diagnostics_tell_a_rollover_from_a_lost_state() -> None:
    going = diagnostics.state_status("truck: state", None, ("steer_left",))
    over = diagnostics.state_status(
        "truck: state", Ending(ROLLED_OVER, 3.2, "trailer", "the trailer rolled over to the left"),
        ())
    lost = diagnostics.state_status(
        "truck: state", Ending(NOT_FINITE, 3.2, "", "the state was no longer finite"), ())
    assert going.level == diagnostics.OK
    assert over.level == lost.level == diagnostics.ERROR
    assert over.message == "the trailer rolled over to the left: stopped; call reset"
    values = {pair.key: pair.value for pair in over.values}
    assert (values["finite"], values["rolled_over"]) == ("true", "trailer")
    assert {pair.key: pair.value for pair in lost.values}["finite"] == "false"


def test_the_node_stops_where_the_truck_rolls_over(start: Any, client: Any) -> None:
    node = start("simulator", "--initial-speed-mps", 27, "--diagnostics-rate-hz", 10,
                 "--input-timeout-s", 0)
    node.wait_for("ready")
    reports = client.listen(DiagnosticArray, "/diagnostics")
    wheel = client.talk(Float64, "/truck/steering_wheel_angle")

    def over() -> bool:
        wheel.publish(Float64(data=4.7))
        return any("rolled over to the right: stopped" in one.message
                   for report in reports for one in report.status)

    client.until(over, what="a rollover on /diagnostics")
    reply = client.call(Trigger, "/truck/resume")
    assert not reply.success
    assert "rolled over to the right: call reset first" in reply.message
    assert client.call(Trigger, "/truck/reset").success
    assert client.call(Trigger, "/truck/resume").success
