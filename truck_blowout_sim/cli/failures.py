"""What a failure looks like in a terminal: one line on stderr and an exit status."""

from __future__ import annotations

import contextlib
import os
import signal
import sys
import threading
import traceback as traceback_module
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import cast

import typer

from truck_blowout_sim.errors import InputError, StorageError

FAILED, REFUSED, INTERRUPTED = 1, 2, 130

# BadParameter < UsageError < ClickException. Newer Typers carry their own copy of click, older ones
# use the real one; reached from Typer's public name, the base is the right one either way.
CLICK_ERROR = typer.BadParameter.__mro__[2]

# A path the user named is not there or not his to use.
PATH_ERRORS = (FileNotFoundError, PermissionError, IsADirectoryError, NotADirectoryError)


class InterruptionError(Exception):
    """A person or the system ended the verb; the message says what is left to be done."""


@contextlib.contextmanager
def interruptible(words: Callable[[], str]) -> Iterator[None]:
    """SIGINT and SIGTERM end the body alike, with one line that ``words`` completes.

    Raises:
        InterruptionError: one of them came.
    """
    def interrupt(number: int, frame: object) -> None:
        raise KeyboardInterrupt

    before = signal.signal(signal.SIGTERM, interrupt) if _in_main_thread() else None
    try:
        yield
    except KeyboardInterrupt:
        raise InterruptionError("; ".join(filter(None, ["interrupted", words()]))) from None
    finally:
        if before is not None:
            signal.signal(signal.SIGTERM, before)


def _in_main_thread() -> bool:
    # Python lets no other thread set a signal's handler.
    return threading.current_thread() is threading.main_thread()


def report(error: BaseException, *, program: str, traceback: bool) -> int:
    """Print one line for an exception and return the exit status it stands for.

    Args:
        error: what ended the verb.
        program: the name the line begins with.
        traceback: print the Python traceback before the line.
    """
    # Typer turns a broken pipe into SystemExit itself.
    if isinstance(error, BrokenPipeError) or isinstance(error.__context__, BrokenPipeError):
        return _reader_left()
    if isinstance(error, SystemExit):
        return error.code if isinstance(error.code, int) else FAILED
    if traceback:
        traceback_module.print_exception(type(error), error, error.__traceback__)
    line, status = _line(error)
    print(f"{program}: {line}", file=sys.stderr)
    return status


def _line(error: BaseException) -> tuple[str, int]:
    if isinstance(error, (InputError, StorageError)):
        return str(error), REFUSED
    if isinstance(error, InterruptionError):
        return str(error), INTERRUPTED
    if isinstance(error, CLICK_ERROR):
        problem = _one_line(cast(typer.BadParameter, error).format_message())
        return f"{problem} (--help shows what is possible)", REFUSED
    if isinstance(error, (KeyboardInterrupt, typer.Abort)):
        return "interrupted", INTERRUPTED
    if isinstance(error, PATH_ERRORS) and error.filename is not None:
        return f"{error.filename}: {error.strerror}", REFUSED
    if isinstance(error, OSError) and error.strerror:
        return ": ".join(filter(None, [_text(error.filename), error.strerror])), FAILED
    return (
        f"internal failure: {type(error).__name__}: {_one_line(str(error))}"
        f" [{_origin(error)}]; --traceback shows more",
        FAILED,
    )


def _origin(error: BaseException) -> str:
    frames = traceback_module.extract_tb(error.__traceback__)
    return f"{Path(frames[-1].filename).name}:{frames[-1].lineno}" if frames else "unknown place"


def _one_line(text: str) -> str:
    return " ".join(text.split())


def _text(value: object) -> str:
    return "" if value is None else str(value)


def _reader_left() -> int:
    # `truck-blowout … | head`: nothing failed. stdout is replaced, or Python complains at exit.
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    return 0
