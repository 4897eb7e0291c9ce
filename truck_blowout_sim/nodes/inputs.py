"""What drives the truck: one guarded value for each command, checked, aged, and made safe.

Nothing here knows ROS. Times are simulated nanoseconds.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

NS = 1_000_000_000


@dataclass
class Input:
    """One command of the truck.

    Attributes:
        name: channel name, unit as suffix.
        topic: relative topic.
        low, high: accepted range, in the channel's unit.
        timeout_s: silence after which `safe_value` applies; 0: never.
        safe_value: also what applies before the first message.
    """

    name: str
    topic: str
    low: float
    high: float
    timeout_s: float
    safe_value: float
    value: float = math.nan
    received_ns: int | None = None
    timed_out: bool = False
    refused: int = 0
    taken: int = 0

    def offer(self, value: float, now_ns: int) -> str:
        """Take a value that arrived, or refuse it.

        A refused message is no sign of life either: the timeout runs on.

        Returns:
            Why it was refused, empty if it was taken.
        """
        if not self.low <= value <= self.high:
            self.refused += 1
            found = "not a number" if math.isnan(value) else f"{value:g}"
            return f"{self.topic}: {found} refused, expected {self.low:g} to {self.high:g}"
        self.value, self.received_ns = value, now_ns
        self.taken += 1
        return ""

    def age_s(self, now_ns: int) -> float:
        """Simulated time since the last good message, seconds; inf before the first."""
        return math.inf if self.received_ns is None else (now_ns - self.received_ns) / NS

    def applied(self, now_ns: int) -> float:
        """The value for a step that begins now."""
        age_s = self.age_s(now_ns)
        # Before the first message nothing is late: nobody has taken the wheel yet.
        self.timed_out = self.received_ns is not None and 0 < self.timeout_s < age_s
        if self.received_ns is None or self.timed_out:
            return self.safe_value
        return self.value

    def shift(self, by_ns: int) -> None:
        """Keep the age of the last message where time jumps by so much."""
        if self.received_ns is not None:
            self.received_ns += by_ns

    def clear(self) -> None:
        """As before the first message."""
        self.value, self.received_ns, self.timed_out = math.nan, None, False


class InputBank:
    """All inputs of a truck, in the order the model takes them."""

    def __init__(self, inputs: Sequence[Input]) -> None:
        self.inputs = tuple(inputs)

    def applied(self, now_ns: int) -> tuple[float, ...]:
        """Values for a step that begins now."""
        return tuple(one.applied(now_ns) for one in self.inputs)

    def shift(self, by_ns: int) -> None:
        """Keep the age of every last message where time jumps by so much."""
        for one in self.inputs:
            one.shift(by_ns)

    def clear(self) -> None:
        """Forget every message, as at the start."""
        for one in self.inputs:
            one.clear()
