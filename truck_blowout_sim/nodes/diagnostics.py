"""`/diagnostics`: factor achieved, lateness, age of each input, recorder, non-finite guard."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from rclpy.node import Node

from truck_blowout_sim.nodes.clock import NS, PaceMeter
from truck_blowout_sim.nodes.inputs import Input
from truck_blowout_sim.simulation.ending import NOT_FINITE, Ending

OK, WARN, ERROR = DiagnosticStatus.OK, DiagnosticStatus.WARN, DiagnosticStatus.ERROR

# An achieved factor below this part of the wanted one is called too slow.
_SLOW = 0.97


def status(name: str, level: bytes, message: str, values: Mapping[str, str]) -> DiagnosticStatus:
    """One entry of a DiagnosticArray."""
    pairs = [KeyValue(key=key, value=value) for key, value in values.items()]
    return DiagnosticStatus(
        name=name, level=level, message=message, hardware_id="truck_blowout_sim", values=pairs
    )


def pace_status(
    name: str,
    meter: PaceMeter,
    wall_s: float,
    now_ns: int,
    *,
    wanted_factor: float | None,
    behind_s: float = 0.0,
    paused: bool = False,
) -> DiagnosticStatus:
    """How time passes; begins a new measuring interval.

    Args:
        name: name of the status.
        meter: ticks since the last report.
        wall_s, now_ns: wall and simulated time now.
        wanted_factor: 0: as fast as possible; None: a followed clock.
        behind_s: how far behind the followed clock.
        paused: time stands on purpose.
    """
    pace = meter.report(wall_s, now_ns)
    factor = pace.factor
    level, words = OK, f"{factor:.3g} simulated seconds a second"
    if paused:
        words = "paused"
    elif wanted_factor and pace.ticks and factor < _SLOW * wanted_factor:
        level, words = WARN, f"cannot keep pace: factor {factor:.3g} of {wanted_factor:g} wanted"
    elif behind_s > 0.5:
        level, words = WARN, f"{behind_s:.2f} s behind the followed clock"
    values = {
        "real_time_factor": f"{factor:.4f}",
        "wanted_factor": "followed clock" if wanted_factor is None else f"{wanted_factor:g}",
        "lateness_mean_ms": f"{pace.late_mean_s * 1e3:.3f}",
        "lateness_p99_ms": f"{pace.late_p99_s * 1e3:.3f}",
        "lateness_worst_ms": f"{pace.late_worst_s * 1e3:.3f}",
        "behind_clock_s": f"{behind_s:.3f}",
        "ticks": str(pace.ticks),
        "simulation_time_s": f"{now_ns / NS:.3f}",
    }
    return status(name, level, words, values)


def inputs_status(name: str, inputs: Sequence[Input], now_ns: int) -> DiagnosticStatus:
    """Age, value and refusals of each input."""
    values = {}
    for one in inputs:
        age_s = one.age_s(now_ns)
        values[f"{one.topic} age_s"] = "never" if math.isinf(age_s) else f"{age_s:.3f}"
        values[f"{one.topic} applied"] = f"{one.applied(now_ns):.6g}"
        values[f"{one.topic} refused"] = str(one.refused)
    late = [one.topic for one in inputs if one.timed_out]
    silent = [one.topic for one in inputs if one.received_ns is None]
    if late:
        return status(name, WARN, f"timed out, safe value applies: {', '.join(late)}", values)
    if silent:
        return status(name, OK, f"not received yet: {', '.join(silent)}", values)
    return status(name, OK, "all inputs alive", values)


def recorder_status(name: str, values: Mapping[str, str]) -> DiagnosticStatus:
    """What the recorder says of itself."""
    if values.get("error"):
        return status(name, ERROR, values["error"], values)
    words = "recording" if values["recording"] == "yes" else "not recording"
    return status(name, OK, words, values)


def state_status(name: str, ending: Ending | None, blown: Sequence[str]) -> DiagnosticStatus:
    """Whether the truck can go on, and which tires are blown."""
    finite, over = ending is None or ending.kind != NOT_FINITE, ending and ending.rolled_over
    values = {"finite": str(finite).lower(), "rolled_over": ending.unit if ending and over else "",
              "blown": " ".join(blown)}
    if ending is not None:
        return status(name, ERROR, f"{ending.words}: stopped; call reset", values)
    return status(name, OK, "state is finite", values)


def waiting_status(name: str, words: str) -> DiagnosticStatus:
    """The truck is not there yet."""
    return status(name, OK, words, {"ready": "false"})


def outputs_status(name: str, node: Node, topics: Sequence[str]) -> DiagnosticStatus:
    """Whether nobody else publishes what this node computes, a played bag above all."""
    mine = (node.get_name(), node.get_namespace())
    others: dict[str, list[str]] = {}
    for topic in topics:
        if node.count_publishers(topic) > 1:
            for end in node.get_publishers_info_by_topic(topic):
                if (end.node_name, end.node_namespace) != mine:
                    full = f"{end.node_namespace.rstrip('/')}/{end.node_name}"
                    others.setdefault(full, []).append(topic)
    if not others:
        return status(name, OK, "nobody else publishes the outputs", {})
    words = "; ".join(
        f"{who} publishes {len(found)} of this node's outputs, too, {found[0]} for one: readers get"
        " both; play back the command topics alone (docs/ros.md)"
        for who, found in others.items()
    )
    return status(name, WARN, words, {who: " ".join(found) for who, found in others.items()})


def clock_status(name: str, node: Node, following: bool) -> DiagnosticStatus:
    """Whether exactly one node publishes `/clock`."""
    count = node.count_publishers("/clock")
    values = {"publishers": str(count)}
    if count > 1:
        return status(name, WARN, f"{count} nodes publish /clock: time will jump", values)
    if following and not count:
        return status(name, WARN, "use_sim_time is set and nobody publishes /clock", values)
    return status(name, OK, "one /clock", values)


def array(stamp_ns: int, entries: Sequence[DiagnosticStatus]) -> DiagnosticArray:
    """The message."""
    out = DiagnosticArray(status=list(entries))
    out.header.stamp.sec, out.header.stamp.nanosec = divmod(stamp_ns, NS)
    return out
