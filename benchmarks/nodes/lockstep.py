"""`python -m benchmarks.nodes.lockstep [-o PAGE]`: how fast the service `step` is."""

from __future__ import annotations

import os
import time
from typing import Any

import rclpy
from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue
from rcl_interfaces.srv import SetParameters
from rclpy.node import Node
from std_srvs.srv import Trigger

from benchmarks.nodes.harness import ENVIRONMENT, Measured, simulator
from benchmarks.page import Page, Place, Table, load, number, start_function
from truck_blowout_sim.nodes.runtime import new_executor

_CALLS = {1: 300, 100: 10, 2000: 2}


def measure(node: Measured) -> Table:
    """A row each number of periods that a call advances; nobody reads."""
    me = Node("benchmark_stepper")
    executor = new_executor()
    executor.add_node(me)

    def call(kind: type, name: str, request: object) -> None:
        client = clients.setdefault(name, me.create_client(kind, name))
        while not client.service_is_ready():
            executor.spin_once(timeout_sec=0.05)
        future = client.call_async(request)
        while not future.done():
            executor.spin_once(timeout_sec=5.0)

    clients: dict[str, Any] = {}
    table = Table("periods a call", "factor", "simulated s a CPU second", "load average")
    for periods, calls in _CALLS.items():
        value = ParameterValue(type=ParameterType.PARAMETER_INTEGER, integer_value=periods)
        change = SetParameters.Request(parameters=[Parameter(name="step_periods", value=value)])
        call(SetParameters, "/truck/simulator/set_parameters", change)
        begin_s, cpu_s = time.monotonic(), node.cpu_s()
        for _ in range(calls):
            call(Trigger, "/truck/step", Trigger.Request())
        simulated_s = periods * calls * 0.01
        factor = simulated_s / (time.monotonic() - begin_s)
        table.row(str(periods), number(factor), number(simulated_s / (node.cpu_s() - cpu_s)),
                  f"{load():.1f}")
    table.row("sought", "60", "60", "")
    executor.shutdown()
    me.destroy_node()
    return table


def main(page: Page = None) -> None:
    """Step a paused node."""
    place = Place(page, "step")
    os.environ.update(ENVIRONMENT)
    with simulator("--initial-speed-mps", 20, "--start-paused") as running:
        rclpy.init()
        table = measure(running)
        rclpy.shutdown()
    place.put(table)


if __name__ == "__main__":
    start_function(main)
