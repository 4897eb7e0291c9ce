"""`python -m benchmarks.nodes.lockstep`: periods a second that the service `step` takes."""

from __future__ import annotations

import os
import time

import rclpy
from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue
from rcl_interfaces.srv import SetParameters
from rclpy.node import Node
from std_srvs.srv import Trigger

from benchmarks.nodes.harness import ENVIRONMENT, Measured, simulator
from truck_blowout_sim.nodes.runtime import new_executor

_CALLS = {1: 300, 100: 10, 2000: 2}


def measure(node: Measured) -> None:
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

    clients: dict[str, object] = {}
    print("| periods a call | periods a second | simulated s a second | simulated s a CPU second |")
    print("|---|---|---|---|")
    for periods, calls in _CALLS.items():
        value = ParameterValue(type=ParameterType.PARAMETER_INTEGER, integer_value=periods)
        change = SetParameters.Request(parameters=[Parameter(name="step_periods", value=value)])
        call(SetParameters, "/truck/simulator/set_parameters", change)
        begin_s, cpu_s = time.monotonic(), node.cpu_s()
        for _ in range(calls):
            call(Trigger, "/truck/step", Trigger.Request())
        rate = periods * calls / (time.monotonic() - begin_s)
        share = periods * calls * 0.01 / (node.cpu_s() - cpu_s)
        print(f"| {periods} | {rate:.0f} | {rate * 0.01:.3g} | {share:.3g} |", flush=True)
    executor.shutdown()
    me.destroy_node()


if __name__ == "__main__":
    os.environ.update(ENVIRONMENT)
    with simulator("--initial-speed-mps", 20, "--start-paused") as running:
        rclpy.init()
        measure(running)
        rclpy.shutdown()
    print(f"load average {os.getloadavg()[0]:.1f}")
