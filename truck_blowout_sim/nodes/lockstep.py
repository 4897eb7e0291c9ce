"""Steps on request: so many publishing periods, each after the controller has answered."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from time import monotonic, sleep
from typing import Any

from truck_blowout_sim.errors import InputError, quoted
from truck_blowout_sim.nodes.command_topics import CommandTopic

_PATIENCE_S = 1.0
_LOOK_EVERY_S = 50e-6


class Lockstep:
    """Advances the simulator by whole publishing periods.

    A command and the call of `step` travel on different roads, and the call may be the faster one.
    Where the run must be the same every time, `step` waits for the commands.

    Args:
        commands: the inputs.
        values: parameters; `step_awaits` and `step_periods` are looked up at each call.
        period: advances by one publishing period; false if the truck cannot go on.
        stopped: asked between periods; true ends the call.
    """

    def __init__(
        self,
        commands: Sequence[CommandTopic],
        values: Mapping[str, Any],
        period: Callable[[], bool],
        stopped: Callable[[], bool],
    ) -> None:
        self._topics = {one.guarded.topic: one for one in commands}
        self._values = values
        self._period = period
        self._stopped = stopped
        self._seen = dict.fromkeys(self._topics, 0)
        self.inputs_named(values["step_awaits"])

    def inputs_named(self, text: str) -> list[CommandTopic]:
        """Inputs of a list joined by commas.

        Raises:
            InputError: no such input.
        """
        names = [word.strip().strip("/") for word in text.split(",") if word.strip()]
        unknown = [name for name in names if name not in self._topics]
        if unknown:
            raise InputError(
                f"{quoted(unknown[0])} is no input", file="parameter", where="step_awaits",
                expected=", ".join(self._topics),
            )  # fmt: skip
        return [self._topics[name] for name in names]

    def advance(self, periods: int) -> tuple[int, str]:
        """Advance; returns the periods done, and why not all of them were."""
        missing = self._await()
        if missing:
            return 0, (f"no new message on {missing} within {_PATIENCE_S:g} s: did not step; a "
                       "controller that joined later gets the first outputs by reset")
        for done in range(periods):
            if self._stopped():
                return done, "the node is ending"
            if not self._period():
                return done + 1, "the truck cannot go on: call reset"
        return periods, ""

    def _await(self) -> str:
        """Wait for the inputs; the topics that are still missing, in words."""
        wanted = self.inputs_named(self._values["step_awaits"])
        end_s = monotonic() + _PATIENCE_S
        while missing := [one for one in wanted if not self._is_new(one)]:
            if monotonic() >= end_s or self._stopped():
                return " and ".join(one.guarded.topic for one in missing)
            sleep(_LOOK_EVERY_S)
        for one in wanted:
            self._seen[one.guarded.topic] = one.guarded.taken
        return ""

    def _is_new(self, one: CommandTopic) -> bool:
        one.drain()
        return one.guarded.taken > self._seen[one.guarded.topic]
