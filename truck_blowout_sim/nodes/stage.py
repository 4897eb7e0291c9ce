"""Sets the simulator for a replay: into the state a recording begins with, its bag running."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from rclpy.executors import Executor

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.nodes.simulator_client import SimulatorClient
from truck_blowout_sim.recordings.recording import Recording
from truck_blowout_sim.simulation.flat import Flat, flat_at
from truck_blowout_sim.simulation.start import initial_state

_INITIAL = (
    "speed_mps",
    "lateral_speed_mps",
    "yaw_rate_radps",
    "x_m",
    "y_m",
    "yaw_rad",
    "articulation_rad",
)


def blown_earlier(recording: Recording) -> tuple[Flat, ...]:
    """Tires that are flat where a recording begins, and how long before they burst."""
    start_s = recording.start_s
    return flat_at((b for b in recording.blowouts if b.time_s < start_s), start_s)


class Stage:
    """What the player does to the simulator before and after the recording.

    Args:
        simulator: its services and parameters.
        record_path: bag for the simulator to write; empty: none.
        say: takes a sentence for the log.
    """

    def __init__(
        self, simulator: SimulatorClient, record_path: str, say: Callable[[str], object]
    ) -> None:
        self._simulator = simulator
        # The simulator may have been started in another folder.
        self._bag = str(Path(record_path).absolute()) if record_path else ""
        self._say = say
        self._recording = False
        self._paused = False

    @property
    def waiting(self) -> bool:
        """Whether the simulator stands paused where the recording begins."""
        return self._paused

    def check(self, executor: Executor) -> None:
        """See that the bag that is wanted can be begun, before anything is changed.

        Raises:
            InputError: the simulator writes another one.
        """
        there = self._simulator.recording_to(executor) if self._bag else None
        if there is not None and there != self._bag:
            raise InputError(f"the simulator is already recording{f' to {there}' if there else ''}",
                             expected="its bag to be ended first: service record, false")

    def set(self, executor: Executor, recording: Recording) -> None:
        """Pause the simulator and put it where the recording begins.

        Raises:
            InputError: it does not answer, or refuses.
        """
        self._simulator.call(executor, "pause")
        self._paused = True
        state = initial_state(recording)
        initial = {f"initial_{name}": float(getattr(state, name)) for name in _INITIAL}
        flat = ",".join(f"{tire}@{since_s:.6f}" for tire, since_s in blown_earlier(recording))
        self._simulator.set_parameters(executor, {**initial, "initial_flat": flat})
        words = self._simulator.call(executor, "reset", timeout_s=60.0)
        if flat:  # for this run alone: the next reset has whole tires
            self._simulator.set_parameters(executor, {"initial_flat": ""})
        self._say(f"simulator at {state.speed_mps:.2f} m/s: {words}")

    def record(self, executor: Executor) -> None:
        """Begin the bag, if one is wanted: after the reset, so that no jump is in it.

        Raises:
            InputError: the simulator cannot record.
        """
        if self._bag:
            self._simulator.set_parameters(executor, {"record_path": self._bag})
            self._say(f"simulator: {self._simulator.record(executor, True)}")
            self._recording = True

    def resume(self, executor: Executor) -> None:
        """Let the simulator run.

        Raises:
            InputError: it refuses.
        """
        self._simulator.call(executor, "resume")
        self._paused = False

    def end_record(self, executor: Executor) -> None:
        """End the bag with the recording: what follows is nobody's experiment.

        Raises:
            InputError: the bag could not be written.
        """
        if self._recording:
            self._recording = False
            self._say(f"simulator: {self._simulator.record(executor, False)}")

    def leave(self, executor: Executor) -> None:
        """Leave the simulator running, and without the player's bag.

        The initial state that was set stays: the next reset returns to where this replay began.
        """
        with self._simulator.to_the_end():
            for last in (self.resume if self._paused else None, self.end_record):
                try:
                    if last is not None:
                        last(executor)
                except InputError as error:
                    self._say(f"simulator: {error}")
