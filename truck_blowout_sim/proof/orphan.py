"""A worker ends with the process that started it, however that one ends.

Validated with: test/proof/test_orphan.py.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from multiprocessing import parent_process
from threading import Thread


def end_with_parent(begin: Callable[[], None]) -> None:
    """First thing in a worker: watch the parent, then ``begin``.

    A parent that was killed cannot tell its workers; without this each would finish its case.
    """
    Thread(target=_watch, daemon=True).start()
    begin()


def _watch() -> None:
    parent = parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)
