"""Parameters that change while the simulator runs."""

from __future__ import annotations

from time import monotonic
from typing import TYPE_CHECKING, Any

from rcl_interfaces.msg import SetParametersResult
from rclpy.node import Node
from rclpy.parameter import Parameter

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.nodes import blow_schedule
from truck_blowout_sim.nodes.clock import WallPace
from truck_blowout_sim.nodes.parameters import check_changes
from truck_blowout_sim.nodes.recorder import check_inside
from truck_blowout_sim.nodes.simulator_parameters import (
    SPECS,
    check_safe_value,
    flat_of,
    timeout_of,
)
from truck_blowout_sim.simulation.flat import check_tires

if TYPE_CHECKING:
    from truck_blowout_sim.nodes.simulator_node import Simulator


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
        try:
            plans = self._checked(changes) if verdict.successful else {}
        except InputError as error:
            return SetParametersResult(successful=False, reason=str(error))
        if verdict.successful:
            for change in changes:
                if change.name in self._rows:
                    value = self._rows[change.name].checked(change.value)
                    self._simulator.values[change.name] = value
            self._apply()
            if "blow" in plans:
                self._simulator.schedule.replace(plans["blow"], self._simulator.plant.elapsed_ns)
        return verdict

    def _checked(self, changes: list[Parameter[Any]]) -> dict[str, Any]:
        """What a row alone cannot judge; the plan of blowouts, if there is one.

        Raises:
            InputError: an unknown tire or input, a bag elsewhere, or a safe value out of range.
        """
        plans: dict[str, Any] = {}
        for change in changes:
            if change.name == "blow":
                plans["blow"] = blow_schedule.parse(change.value, self._simulator.plant.parts)
            elif change.name == "initial_flat":
                check_tires(self._simulator.plant.vehicle, flat_of(change.value))
            elif change.name == "step_awaits":
                self._simulator.lockstep.inputs_named(change.value)
            elif change.name == "record_path":
                check_inside(self._simulator.recorder.folder, change.value)
            for one in self._simulator.plant.bank.inputs:
                if change.name == f"inputs.{one.name}.safe_value":
                    check_safe_value(one, float(change.value))
        return plans

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
