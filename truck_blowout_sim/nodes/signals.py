"""Ending on SIGINT, SIGTERM or SIGHUP: a flag that the loop of a node looks at.

rclpy's own handlers shut the context down under the feet of whatever is being published or
recorded, and Ctrl-C under a launcher arrives twice. So the node keeps its context, sees the flag,
finishes its bag, and shuts rclpy down itself.
"""

from __future__ import annotations

import signal
from types import FrameType, TracebackType
from typing import NoReturn

CAUGHT = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)


class Interrupted(BaseException):
    """Asked to end while nothing has begun that would have to be finished."""


class StopFlag:
    """Context manager: true once the process was asked to end, however often it is asked.

    While `at_once` is set, being asked raises `Interrupted` instead: the first start compiles the
    model, which takes longer than a launcher waits.
    """

    def __init__(self) -> None:
        self.stopped = False
        self.at_once = False
        self.interrupted = False  # what is being imported may wrap `Interrupted` in another error
        self.reason = ""
        self._before: dict[int, object] = {}

    def __enter__(self) -> StopFlag:
        for number in CAUGHT:
            # `nohup` asks to outlive the terminal. An ignored SIGINT only says that a script put
            # the node into the background; who sends it one (`kill -INT`, a launcher) means it.
            if number == signal.SIGHUP and signal.getsignal(number) == signal.SIG_IGN:
                continue
            self._before[number] = signal.signal(number, self._catch)
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        for number, handler in self._before.items():
            # A second Ctrl-C while the interpreter ends would spoil the exit status.
            signal.signal(number, signal.SIG_IGN if self.stopped else handler)  # type: ignore[arg-type]

    def __bool__(self) -> bool:
        return self.stopped

    def stop(self, reason: str) -> None:
        """Ask the loop to end, from inside the program."""
        self.stopped, self.reason = True, reason

    def interrupt(self) -> NoReturn:
        """End what has not begun.

        Raises:
            Interrupted: always.
        """
        self.at_once, self.interrupted = False, True
        raise Interrupted(self.reason)

    def _catch(self, number: int, frame: FrameType | None) -> None:
        self.stop(signal.Signals(number).name)
        if self.at_once:
            self.interrupt()
