"""The player node: `ros2 run truck_blowout_sim player RECORDING`.

Plays a recording onto the simulator's command topics, calls the blowout service at the recorded
instant, and publishes what was measured under `measured/`.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from time import monotonic
from typing import Any

from rcl_interfaces.msg import SetParametersResult
from rclpy.duration import Duration
from rclpy.executors import Executor
from rclpy.node import Node
from rclpy.parameter import Parameter

from truck_blowout_sim import read_recording
from truck_blowout_sim.errors import InputError
from truck_blowout_sim.nodes import runtime
from truck_blowout_sim.nodes.pace_watch import PaceWatch
from truck_blowout_sim.nodes.parameters import check_changes
from truck_blowout_sim.nodes.player_parameters import SPECS, check_names, remappings
from truck_blowout_sim.nodes.player_services import serve
from truck_blowout_sim.nodes.playlist import Due, Playlist
from truck_blowout_sim.nodes.playtime import ClockTime, WallTime
from truck_blowout_sim.nodes.publishing import make_publishers
from truck_blowout_sim.nodes.signals import StopFlag
from truck_blowout_sim.nodes.simulator_client import SimulatorClient
from truck_blowout_sim.nodes.stage import Stage
from truck_blowout_sim.recordings.blowout_words import parse_blowouts
from truck_blowout_sim.recordings.cdr import template
from truck_blowout_sim.recordings.channels import BLOWOUT_EVENT, STRING, channels_for
from truck_blowout_sim.recordings.shipped import find_recording

ABOUT = ("Plays a recording onto the simulator's command topics and blows its tires on time."
         " Example: truck-blowout player test_2013_steer_blowout --record-path again")

COMMANDS = frozenset(row.topic for row in channels_for((), (), ()) if row.group == "input")
_IDLE_S = 0.05
_DISCOVERY_S = 0.3
_DELIVERY_S = 1.0
_BACKLOG = 1000  # a burst after a stall must not push out what no reader has yet


class Player:
    """The node's parts, and its loop."""

    def __init__(self, node: Node, values: dict[str, Any]) -> None:
        if not values["recording"]:
            raise InputError("no recording named", expected="player RECORDING, or -p recording:=…")
        check_names(values)
        self.node = node
        self.values = values
        self.log = node.get_logger()
        self.paused: bool = values["start_paused"]
        remap = remappings(values["remap"])
        if remap and values["map"]:
            raise InputError("remap and map are both given", file="parameter", where="remap",
                             expected="the mapping file alone; it names topics, too")  # fmt: skip
        recording = read_recording(
            find_recording(values["recording"]), remap=remap or None,
            mapping=values["map"] or None, also=[word for word in values["also"] if word],
            blow=parse_blowouts([word for word in values["blow"].split(",") if word.strip()]),
        )  # fmt: skip
        self.playlist = Playlist(recording)
        self.start_s = recording.start_s + values["start_offset"]
        length_s = values["playback_duration"]
        self.end_s = min(recording.end_s, self.start_s + length_s) if length_s else recording.end_s
        if not self.start_s <= self.end_s:
            raise InputError(
                f"start_offset {values['start_offset']:g} s lies behind its end",
                file=values["recording"], expected=f"less than {recording.duration_s:.3f} s",
            )  # fmt: skip
        following = bool(node.get_parameter("use_sim_time").value)
        self.time: ClockTime | WallTime = (
            ClockTime(node, values["rate"]) if following else WallTime(node, values["rate"])
        )
        self.pace = None if following else PaceWatch(node, values["rate"])
        self.publishers = self._make_publishers()
        self._stop: StopFlag | None = None
        self.simulator = SimulatorClient(node, values["simulator"], lambda: bool(self._stop))
        self.simulator.prepare_blowouts({t for b in recording.blowouts for t in b.tires})
        self.stage = Stage(self.simulator, values["record_path"], self.log.info)
        self._under_way = False  # from the first resume or play_next of a pass on
        self._stepped = False  # play_next came before
        self.published = 0
        self.blown: list[str] = []
        serve(node, self)
        node.add_on_set_parameters_callback(self._change)

    def run(self, executor: Executor, stop: StopFlag) -> int:
        """Play to the end, or until asked to end."""
        self._stop = stop
        self._list()
        present = self.simulator.wait(executor, self.values["wait_for_simulator_s"])
        if not present and self.values["wait_for_simulator_s"]:
            self.log.warning("no simulator found; playing without it")
        self.simulator.until(executor, lambda: False, self.values["delay"])
        try:
            while not stop:
                self._begin(executor, present)
                self._play(executor, stop)
                if not stop:
                    self._finish(executor)
                if stop or not self.values["loop"]:
                    break
        except InputError:
            if not stop:  # what was waited for did not come because the wait was ended
                raise
        finally:
            # also when the recording cannot be played, or Ctrl-C has come
            self.stage.leave(executor)
        self._summary(stop)
        return 0

    def close(self) -> None:
        """Nothing is left open."""

    def play_next(self) -> str:
        """Publish the next instant, while paused; what was done, in words."""
        next_s = self.playlist.next_s
        if next_s is None or next_s > self.end_s:
            return ""
        self.time.move_to(next_s)
        if not (self._stepped or self._under_way):
            self._apply_what_holds()
        self._stepped = True
        self._publish_until(next_s)
        return f"played {self._into(next_s):.3f} s"

    def seek(self, time_s: float) -> None:
        """Go on at an instant of the recording's clock."""
        self.playlist.seek(time_s)
        self.time.move_to(time_s)

    def set_paused(self, paused: bool) -> None:
        """Pause or go on."""
        if paused != self.paused:
            self.paused = paused
            if self._under_way:
                self.time.hold() if paused else self.time.go()

    # inside

    def _begin(self, executor: Executor, present: bool) -> None:
        self._under_way = self._stepped = False
        self.playlist.seek(self.start_s)
        self.time.hold()
        self.time.move_to(self.start_s)
        prepare = present and self.values["prepare_simulator"]
        if present:
            self.stage.check(executor)
        if prepare:
            self._await_readers(executor)
            recording = self.playlist.recording
            self.stage.set(executor, recording.between(self.start_s, recording.end_s))
        if present:
            self.stage.record(executor)
        self.time.begin(executor, self._stop, self.start_s, self.log.warning)

    def _set_off(self, executor: Executor) -> None:
        """Send the first commands and let the simulator run, which waits for them."""
        if not self._stepped:
            self.time.move_to(self.time.position_s)
            self._apply_what_holds()
            self._publish_until(self.time.position_s)
        self._deliver(COMMANDS & self.publishers.keys())
        if self.stage.waiting:
            self.simulator.settle(executor, _DELIVERY_S)
            self.stage.resume(executor)
        if self.pace:
            self.pace.begin()
        self._under_way = True
        if not self.paused:
            self.time.start()

    def _finish(self, executor: Executor) -> None:
        self.simulator.settle(executor, 2.0)
        self._deliver(self.publishers)
        self.stage.end_record(executor)

    def _play(self, executor: Executor, stop: StopFlag) -> None:
        while not stop:
            if not self._under_way and (self._stepped or not self.paused):
                self._set_off(executor)
            next_s = self.playlist.next_s
            if next_s is None or next_s > self.end_s:
                return
            wait_s = _IDLE_S if self.paused else self.time.wait_s(next_s)
            if wait_s > 0.0:
                executor.spin_once(timeout_sec=min(wait_s, _IDLE_S))
            else:
                # what the time calls due is played: a difference of rounding must not spin for ever
                self._publish_until(min(max(self.time.position_s, next_s), self.end_s))

    def _apply_what_holds(self) -> None:
        """Commands given before the start, and on a truck that was put there the blown tires."""
        if self.stage.waiting:
            for due in self.playlist.blown_before(self.start_s):
                self._tell_flat(due)
        for topic, data in self.playlist.held(self.time.position_s).items():
            if topic in COMMANDS:
                self._publish(topic, data)

    def _tell_flat(self, due: Due) -> None:
        """Name the tires on which the simulator was put at the start."""
        for tire in due.tires:
            self.publishers[BLOWOUT_EVENT.topic].publish(template(STRING, data=tire))
            self.blown.append(tire)
            self.log.warning(
                f"{tire} burst {self.start_s - due.time_s:.3f} s before the start: the simulator"
                " begins settled on it, so the replay cannot equal the recording")

    def _into(self, time_s: float) -> float:
        """Seconds since the recording began."""
        return time_s - self.playlist.recording.start_s

    def _publish_until(self, time_s: float) -> None:
        for due in self.playlist.due(time_s):
            stamp_ns = self.time.stamp_ns(due.time_s)
            for topic, data in self.playlist.messages(due, stamp_ns).items():
                self._publish(topic, data)
            self._blow(due)

    def _publish(self, topic: str, data: bytes) -> None:
        publisher = self.publishers.get(topic)
        if publisher is not None:
            publisher.publish(data)
            self.published += 1

    def _blow(self, due: Due) -> None:
        at_s = self._into(due.time_s)
        for tire in due.tires:
            self.publishers[BLOWOUT_EVENT.topic].publish(template(STRING, data=tire))
            if self.simulator.blow(tire, self._say_reply):
                self.blown.append(tire)
                self.log.info(f"{tire} blown, {at_s:.3f} s into the recording")
            else:
                self.log.error(f"nobody serves blowout/{tire}, {at_s:.3f} s into the recording")

    def _say_reply(self, words: str) -> None:
        self.log.info(f"simulator: {words}")

    def _await_readers(self, executor: Executor) -> None:
        """Let discovery come to its end: what is sent before a reader knows its writer is lost."""
        commands = [self.publishers[topic] for topic in COMMANDS & self.publishers.keys()]
        self.simulator.until(
            executor, lambda: all(one.get_subscription_count() for one in commands), 5.0
        )
        self.simulator.until(executor, lambda: False, _DISCOVERY_S)

    def _deliver(self, topics: Iterable[str]) -> None:
        """Wait until these have arrived: the first before a step, the last before the end."""
        end_s = monotonic() + _DELIVERY_S
        for topic in topics:
            left_s = max(0.0, end_s - monotonic())  # a negative time would wait for ever
            self.publishers[topic].wait_for_all_acked(Duration(seconds=left_s))

    def _make_publishers(self) -> dict[str, Any]:
        types = {topic: ros_type for topic, (ros_type, _) in self.playlist.topics.items()}
        commands = {topic: kind for topic, kind in types.items() if topic in COMMANDS}
        made = make_publishers(self.node, commands, depth=_BACKLOG)
        prefix = self.values["measured"].rstrip("/") + "/"
        measured = {BLOWOUT_EVENT.topic: STRING}
        if self.values["publish_measured"]:
            measured |= {topic: kind for topic, kind in types.items() if topic not in COMMANDS}
        return made | make_publishers(self.node, measured, prefix=prefix, depth=_BACKLOG)

    def _list(self) -> None:
        recording = self.playlist.recording
        self.log.info(
            f"{recording.name}: {self.end_s - self.start_s:.3f} s from {self.start_s:.3f} s on"
        )
        for topic, (ros_type, count) in self.playlist.topics.items():
            if topic in self.publishers:
                name = self.publishers[topic].topic_name
                self.log.info(f"  {name} ({ros_type}): {count} messages")
        for blowout in recording.blowouts:
            tires, at_s = " and ".join(blowout.tires), self._into(blowout.time_s)
            self.log.info(f"  blowout of {tires}, {at_s:.3f} s into the recording")
        for note in recording.notes:
            self.log.info(f"  note: {note}")

    def _summary(self, stop: StopFlag) -> None:
        why = f"stopped by {stop.reason}" if stop else "end of the recording"
        blown = ", ".join(dict.fromkeys(self.blown)) or "no tire"
        self.log.info(f"{why}: {self.published} messages published, {blown} blown,"
                      f" worst lateness {self.time.worst_late_s * 1e3:.1f} ms")  # fmt: skip
        if self.pace and self.pace.warning:
            self.log.warning(self.pace.warning)

    def _change(self, changes: list[Parameter[Any]]) -> SetParametersResult:
        verdict = check_changes(SPECS, changes)
        if verdict.successful:
            self.values |= {c.name: c.value for c in changes if c.name in self.values}
        return verdict


def main(arguments: Sequence[str] | None, stop: StopFlag) -> int:
    """Run the node; see `door.open_node`."""
    return runtime.run(
        "player", SPECS, Player, about=ABOUT, arguments=arguments, stop=stop, positional="recording"
    )
