"""Work in a thread while the node goes on answering."""

from __future__ import annotations

import threading
from collections.abc import Callable


class Background:
    """Runs a function once, in a thread that does not keep the process alive.

    Args:
        work: what to do.
        name: of the thread.
    """

    def __init__(self, work: Callable[[], object], name: str) -> None:
        self._work = work
        self._error: Exception | None = None
        self._thread = threading.Thread(target=self._run, name=name, daemon=True)
        self._thread.start()

    @property
    def done(self) -> bool:
        """Whether it has ended."""
        return not self._thread.is_alive()

    def check(self) -> None:
        """Raise what the work raised."""
        self._thread.join()
        if self._error is not None:
            raise self._error

    def _run(self) -> None:
        try:
            self._work()
        except Exception as error:  # noqa: BLE001  # raised again by `check`
            self._error = error
