"""Parameters that change while the simulator runs."""

from __future__ import annotations

from time import monotonic
from typing import TYPE_CHECKING, Any

from rcl_interfaces.msg import SetParametersResult
from rclpy.node import Node
from rclpy.parameter import Parameter

from truck_blowout_sim.nodes.clock import WallPace
from truck_blowout_sim.nodes.parameters import check_changes
from truck_blowout_sim.nodes.simulator_parameters import SPECS, timeout_of

if TYPE_CHECKING:
    from truck_blowout_sim.nodes.simulator import Simulator


class LiveParameters:
    """Checks requests to change parameters, and applies them at once."""

    def __init__(self, node: Node, simulator: Simulator) -> None:
        self._simulator = simulator
        self._rows = {spec.name: spec for spec in SPECS}
        node.add_on_set_parameters_callback(self._change)

    def _change(self, changes: list[Parameter[Any]]) -> SetParametersResult:
        if any(change.name == "use_sim_time" for change in changes):
            return SetParametersResult(successful=False, reason="use_sim_time is set at the start")
        verdict = check_changes(SPECS, changes)
        if verdict.successful:
            for change in changes:
                if change.name in self._rows:
                    value = self._rows[change.name].checked(change.value)
                    self._simulator.values[change.name] = value
            self._apply()
        return verdict

    def _apply(self) -> None:
        simulator = self._simulator
        for one in simulator.plant.bank.inputs:
            one.timeout_s = timeout_of(simulator.values, one.name)
            one.safe_value = simulator.values[f"inputs.{one.name}.safe_value"]
        pace, factor = simulator.pace, simulator.values["real_time_factor"]
        if isinstance(pace, WallPace) and pace.factor != factor:
            pace.factor = factor
            pace.restart(monotonic())
            simulator.meter.restart(monotonic(), simulator.plant.now_ns)
