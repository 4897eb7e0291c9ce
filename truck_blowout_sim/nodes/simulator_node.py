"""The simulator node: `ros2 run truck_blowout_sim simulator`. Topics, services: docs/ros.md."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from time import monotonic
from typing import Any

from rclpy.executors import Executor
from rclpy.node import Node

from truck_blowout_sim import load_vehicle
from truck_blowout_sim.nodes import blow_schedule, runtime
from truck_blowout_sim.nodes.adapters import attach_all
from truck_blowout_sim.nodes.background import Background
from truck_blowout_sim.nodes.blow_schedule import BlowSchedule
from truck_blowout_sim.nodes.clock import NS, FollowPace, PaceMeter, WallPace
from truck_blowout_sim.nodes.clock_topics import ClockPublisher, FollowedClock
from truck_blowout_sim.nodes.command_topics import CommandTopic
from truck_blowout_sim.nodes.door import COMPILER
from truck_blowout_sim.nodes.inputs import InputBank
from truck_blowout_sim.nodes.live_parameters import LiveParameters
from truck_blowout_sim.nodes.lockstep import Lockstep
from truck_blowout_sim.nodes.output_topics import OutputTopics
from truck_blowout_sim.nodes.plant import Plant
from truck_blowout_sim.nodes.recorder import Recorder
from truck_blowout_sim.nodes.report import Reporter
from truck_blowout_sim.nodes.services import Reply, serve
from truck_blowout_sim.nodes.signals import StopFlag
from truck_blowout_sim.nodes.simulator_parameters import (
    SPECS,
    initial_state,
    inputs_of,
    timing_of,
)
from truck_blowout_sim.nodes.wheel_and_blowout_topics import accept_wheel_and_blowout

ABOUT = ("Simulates a truck in real time; steer, brake and blow its tires over ROS 2."
         " Example: truck-blowout simulator --initial-speed-mps 23")

_IDLE_S = 0.1
_SERVE_EVERY_S = 0.005
_MOST_EVENTS = 100
_IDLE_TURN_S = 60e-6
_BUILDING_TURN_S = 0.05


class Simulator:
    """The node's parts, and its loop."""

    def __init__(self, node: Node, values: dict[str, Any]) -> None:
        self.node = node
        self.values = values
        self.log = node.get_logger()
        self._stop: StopFlag | None = None
        self._building_since_s = monotonic()
        self.paused: bool = values["start_paused"]
        following = bool(node.get_parameter("use_sim_time").value)
        self.timing = timing_of(values, following=following)
        vehicle = load_vehicle(values["vehicle"])
        self.plant = Plant(
            vehicle, values["step_s"], initial_state(values),
            InputBank(inputs_of(values, vehicle.spec.brakes)),
        )  # fmt: skip
        self.schedule = BlowSchedule(blow_schedule.parse(values["blow"], self.plant.parts))
        folder = Path(values["record_folder"] or ".").absolute()
        self.recorder = Recorder(self._say, {"vehicle": vehicle.name}, folder)
        self.outputs = OutputTopics(node, self.plant, self.timing, values, self.recorder)
        self.commands = [
            CommandTopic(node, one, lambda: self.plant.now_ns, self.recorder)
            for one in self.plant.bank.inputs
        ]
        self.lockstep = Lockstep(self.commands, values, self._period, lambda: bool(self._stop))
        self._blowouts_taken = accept_wheel_and_blowout(node, self)
        tick_s = self.timing.tick_steps * values["step_s"]
        self.pace: WallPace | FollowPace
        self.clock: ClockPublisher | None = None
        if following:
            self.pace = FollowPace(round(tick_s * NS))
            self.followed = FollowedClock(node, self, self.pace, values)
        else:
            self.pace = WallPace(tick_s, values["real_time_factor"], monotonic())
            self.clock = ClockPublisher(node, self.timing.clock_every)
        self.meter = PaceMeter(monotonic(), self.plant.now_ns)
        self.reporter = Reporter(node, self)
        serve(node, self, self.plant.parts)
        active = attach_all(node, self)
        if active:
            self.log.info(f"adapters: {', '.join(active)}")
        self._serve_at_s = 0.0
        LiveParameters(node, self)
        for note in self.timing.notes:
            self.log.warning(note)

    @property
    def period_steps(self) -> int:
        """Steps of a publishing period."""
        return self.timing.tick_steps * self.timing.publish_every

    def run(self, executor: Executor, stop: StopFlag) -> int:
        """Tick when the pace says so, until asked to end."""
        self._stop = stop
        self._build(executor, stop)
        if self.clock or self.pace.known:
            self.begin()
        self._announce()
        self.pace.restart(monotonic())
        while not stop:
            wall_s = monotonic()
            self.reporter.spin(wall_s)
            wait_s = _IDLE_S if self.paused else self.pace.wait_s(wall_s, self.plant.now_ns)
            if wait_s > 0.0:
                executor.spin_once(timeout_sec=min(wait_s, _IDLE_S))
                self._serve_at_s = wall_s + _SERVE_EVERY_S
            else:
                self._serve(executor, wall_s)
                if not self.paused:  # by what was served just now
                    self.meter.tick(self.pace.ticked(wall_s))
                    self.tick()
        self.log.info(f"{stop.reason}: ended at {self.plant.now_ns / NS:.3f} s of simulation time")
        return 0

    def begin(self) -> None:
        """The truck is there and the time known: show the initial state, and record if asked to."""
        if self.clock:
            self.clock.publish(self.plant.now_ns, always=True)
        self.outputs.publish(everything=True)
        if self.values["record_path"]:
            self.record(True)

    def tick(self) -> None:
        """Advance by one tick and publish what is due."""
        for part in self.schedule.due(self.plant.elapsed_ns):
            self.blow(part)
        for topic in self.commands:
            topic.drain()
        before = self.plant.applied
        self.plant.advance(self.timing.tick_steps)
        if self.plant.applied != before:
            self._record_safe_values(before)
        if self.clock:
            self.clock.publish(self.plant.now_ns)
        self.outputs.publish()
        if ending := self.plant.truck.ending:
            self.paused = True
            self.log.fatal(f"{ending.words} at {self.plant.now_ns / NS:.3f} s: stopped; call reset")

    def close(self) -> None:
        """Finish the bag."""
        self.recorder.stop()

    def restart(self, why: str) -> None:
        """Initial state, whole tires; simulated time is not touched."""
        self.plant.reset(initial_state(self.values), self.period_steps)
        self.schedule.restart()
        if self._blowouts_taken:
            self._blowouts_taken.forget()
        self.outputs.restart()
        self._record_inputs()
        self.meter.restart(monotonic(), self.plant.now_ns)
        self.log.info(f"reset: {why}")

    # services

    def blow(self, part: str) -> Reply:
        """Blow a tire, or all tires of a hub."""
        fresh, words = self.plant.blow(part)
        for tire in fresh:
            self.outputs.announce_blowout(tire)
        self.log.info(words)
        return True, words

    def ready(self) -> Reply:
        """Whether the truck is there."""
        if self.plant.ready:
            return True, "ready"
        since_s = monotonic() - self._building_since_s
        return False, f"the model is being compiled, for {since_s:.0f} s so far: try again later"

    def pause(self) -> Reply:
        """Stop time."""
        self.paused = True
        return True, f"paused at {self.plant.now_ns / NS:.3f} s"

    def resume(self) -> Reply:
        """Let time run."""
        if ending := self.plant.truck.ending:
            return False, f"{ending.words}: call reset first"
        if self.paused and isinstance(self.pace, FollowPace):
            self.followed.rejoin()
        self.paused = False
        self.pace.restart(monotonic())
        self.meter.restart(monotonic(), self.plant.now_ns)
        return True, f"running from {self.plant.now_ns / NS:.3f} s"

    def step(self) -> Reply:
        """Advance by `step_periods` publishing periods, while paused."""
        return self.step_by(self.values["step_periods"])

    def step_by(self, periods: int) -> Reply:
        """Advance by publishing periods, while paused; outputs are published before the reply."""
        if not self.paused:
            return False, "step works while paused: call pause first"
        if ending := self.plant.truck.ending:
            return False, f"{ending.words}: call reset first"
        done, why = self.lockstep.advance(periods)
        words = f"stepped to {self.plant.now_ns / NS:.3f} s, {done} of {periods} periods"
        return not why, f"{words}: {why}" if why else words

    def reset(self) -> Reply:
        """Initial state, tires whole but for `initial_flat`; simulated time goes on."""
        self.restart("asked by service")
        if self.clock:
            self.clock.publish(self.plant.now_ns, always=True)
        self.outputs.publish(everything=True)
        flat = " and ".join(self.plant.blown_ns)
        return True, (
            f"initial state, {f'{flat} flat' if flat else 'all tires whole'};"
            f" simulation time goes on at {self.plant.now_ns / NS:.3f} s"
        )

    def record(self, wanted: bool) -> Reply:
        """Start or stop a bag."""
        if not wanted:
            return self.recorder.stop()
        if isinstance(self.pace, FollowPace) and self.pace.target_ns is None:
            return False, "nobody has said on /clock what time it is"
        running = self.recorder.active
        reply = self.recorder.start(self.values["record_path"])
        if self.recorder.active and not running:
            self.outputs.record()
            self._record_inputs()
        return reply

    def is_recording(self) -> Reply:
        """Whether a bag is open, and the path that was asked for it."""
        # a trigger has one flag: here it is the answer
        return self.recorder.active, self.recorder.wanted

    def quit(self) -> Reply:
        """End the node, as SIGINT does."""
        if self._stop is not None:
            self._stop.stop("asked by service")
        return True, "quitting"

    # inside

    def _build(self, executor: Executor, stop: StopFlag) -> None:
        """Build the truck, compiling the model if need be, while topics and services exist."""
        name = self.plant.vehicle.name
        self.log.info(f"loading {name} (only the first start compiles the model, for 20 to 40 s)")
        work = Background(self.plant.build, COMPILER)
        while not work.done:
            if stop:
                stop.interrupt()
            self.reporter.spin(monotonic())
            executor.spin_once(timeout_sec=_BUILDING_TURN_S)
        work.check()
        self.meter.restart(monotonic(), self.plant.now_ns)

    def _period(self) -> bool:
        for _ in range(self.timing.publish_every):
            self.tick()
            if self.plant.truck.ending:
                return False
        return True

    def _serve(self, executor: Executor, wall_s: float) -> None:
        """Let the executor handle what waits, now and then, when no tick leaves it time to."""
        if wall_s < self._serve_at_s:
            return
        for _ in range(_MOST_EVENTS):
            before_s = monotonic()
            executor.spin_once(timeout_sec=0.0)
            # an event is handled in less time than it takes to find that there is none
            if monotonic() - before_s > _IDLE_TURN_S:
                break
        self._serve_at_s = monotonic() + _SERVE_EVERY_S

    def _record_inputs(self) -> None:
        """Write what applies now, where no message says it: at a bag's begin and after a reset."""
        if self.recorder.active:
            for topic, value in zip(self.commands, self.plant.applied, strict=True):
                topic.record(value)

    def _record_safe_values(self, before: Sequence[float]) -> None:
        for topic, old, new in zip(self.commands, before, self.plant.applied, strict=True):
            if topic.guarded.timed_out and old != new:
                topic.record(new)

    def _announce(self) -> None:
        plant = self.plant
        kind = "following /clock" if not self.clock else "publishing /clock"
        self.log.info(
            f"{plant.vehicle.name}: {len(plant.vehicle.hubs)} hubs, {len(plant.vehicle.tires)}"
            f" tires, {kind}{', paused' if self.paused else ''}; ready"
        )

    def _say(self, level: str, words: str) -> None:
        # a call site of rclpy's logger keeps its severity for ever
        if level == "error":
            self.log.error(words)
        else:
            self.log.info(words)


def main(arguments: Sequence[str] | None, stop: StopFlag) -> int:
    """Run the node; see `door.open_node`."""
    return runtime.run("simulator", SPECS, Simulator, about=ABOUT, arguments=arguments, stop=stop)
