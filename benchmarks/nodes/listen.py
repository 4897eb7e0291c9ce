"""A listener: `listen SECONDS` reports arrivals and diagnostics.

`listen reliable` and `listen best_effort` only read, every output.
"""

from __future__ import annotations

import json
import signal
import struct
import sys
import time
from types import FrameType

import rclpy
from diagnostic_msgs.msg import DiagnosticArray
from nav_msgs.msg import Odometry
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rclpy.serialization import deserialize_message

from truck_blowout_sim import load_vehicle
from truck_blowout_sim.nodes.outputs import output_channels
from truck_blowout_sim.nodes.publishing import message_class
from truck_blowout_sim.nodes.runtime import new_executor

_SPEED_EVERY = 100  # messages


def _leave(number: int, frame: FrameType | None) -> None:
    raise SystemExit(0)


def discard(reliability: ReliabilityPolicy) -> None:
    node = Node("benchmark_reader")
    qos = QoSProfile(depth=10, reliability=reliability)
    seen = set()
    for channel in output_channels(load_vehicle("international_9400i_trailmobile")):
        for place in channel.places:
            if place.topic not in seen:
                seen.add(place.topic)
                node.create_subscription(
                    message_class(place.ros_type), f"/truck/{place.topic}", lambda _: None,
                    qos, raw=True,
                )  # fmt: skip
    executor = new_executor()
    executor.add_node(node)
    for _ in range(100):
        executor.spin_once(timeout_sec=0.02)
    print(f"reading {len(seen)} topics", flush=True)
    while True:
        executor.spin_once(timeout_sec=0.1)


def report(duration_s: float) -> None:
    node = Node("benchmark_listener")
    executor = new_executor()
    executor.add_node(node)
    names = ("arrival_s", "stamp_s", "factor", "late_p99_ms", "not_finite", "speed_mps")
    found: dict[str, list[float]] = {name: [] for name in names}

    def diagnose(message: DiagnosticArray) -> None:
        pace = next((status for status in message.status if status.name.endswith("pace")), None)
        if pace is None:  # the model is still being compiled
            return
        values = {pair.key: pair.value for pair in pace.values}
        found["factor"].append(float(values["real_time_factor"]))
        found["late_p99_ms"].append(float(values["lateness_p99_ms"]))
        ends = [status for status in message.status if status.name.endswith("state")]
        found["not_finite"].append(float(any(status.level != b"\x00" for status in ends)))

    def arrive(data: bytes) -> None:
        found["arrival_s"].append(time.monotonic())
        # header.stamp comes first, behind four bytes that state the encoding
        second, nanosecond = struct.unpack_from("<iI", data, 4)
        found["stamp_s"].append(second + 1e-9 * nanosecond)
        if len(found["arrival_s"]) % _SPEED_EVERY == 0:
            found["speed_mps"].append(deserialize_message(data, Odometry).twist.twist.linear.x)

    node.create_subscription(
        Odometry, "/truck/tractor/odometry", arrive, QoSProfile(depth=100), raw=True
    )
    node.create_subscription(DiagnosticArray, "/diagnostics", diagnose, 10)
    end_s = time.monotonic() + duration_s
    while (left_s := end_s - time.monotonic()) > 0:
        executor.spin_once(timeout_sec=left_s)
    print(json.dumps(found))


if __name__ == "__main__":
    signal.signal(signal.SIGTERM, _leave)
    rclpy.init()
    if sys.argv[1] in ("reliable", "best_effort"):
        discard(ReliabilityPolicy[sys.argv[1].upper()])
    else:
        report(float(sys.argv[1]))
