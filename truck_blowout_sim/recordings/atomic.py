"""Files and folders that appear whole or not at all."""

from __future__ import annotations

import contextlib
import os
import shutil
from collections.abc import Iterator
from pathlib import Path

from truck_blowout_sim.errors import StorageError


@contextlib.contextmanager
def replacing(path: Path) -> Iterator[Path]:
    """Give a temporary path beside the wanted one; rename it there if the body succeeds.

    Works for a file and for a folder; an older one of that name is replaced in the end, and left
    alone if the body fails. A file never replaces a folder.

    Raises:
        StorageError: the operating system refuses.
    """
    temporary = path.with_name(f".{path.stem}.{os.getpid()}.part{path.suffix}")
    try:
        with _told_of(path):
            path.parent.mkdir(parents=True, exist_ok=True)
            yield temporary
            _swap(temporary, path)
    finally:
        _remove(temporary)


@contextlib.contextmanager
def replacing_all(folder: Path) -> Iterator[Path]:
    """Give a temporary folder; move its files into the wanted one if the body succeeds.

    Files replace older ones of their names; others in the folder stay. If the body fails, nothing
    has changed.

    Raises:
        StorageError: the operating system refuses.
    """
    there, temporary = folder.exists(), folder / f".{os.getpid()}.part"
    try:
        with _told_of(folder):
            temporary.mkdir(parents=True, exist_ok=True)
            yield temporary
            for path in sorted(p for p in temporary.rglob("*") if p.is_file()):
                wanted = folder / path.relative_to(temporary)
                wanted.parent.mkdir(parents=True, exist_ok=True)
                os.replace(path, wanted)
    finally:
        _remove(temporary)
        if not there:
            with contextlib.suppress(OSError):  # not empty: the files are in place
                folder.rmdir()


@contextlib.contextmanager
def _told_of(path: Path) -> Iterator[None]:
    """Name the wanted path where the operating system refuses."""
    try:
        yield
    except StorageError as error:
        # what the error says is saved goes with the temporary
        raise StorageError(error.problem, file=path, number=error.errno or 5) from error
    except OSError as error:
        words = f"cannot write: {error.strerror or error}"
        raise StorageError(words, file=path, number=error.errno or 5) from error


def _swap(temporary: Path, path: Path) -> None:
    if not (path.is_dir() and temporary.is_dir()):
        os.replace(temporary, path)  # which refuses to put a file in place of a folder
        return
    old = path.with_name(f".{path.name}.{os.getpid()}.old")
    os.replace(path, old)
    os.replace(temporary, path)
    shutil.rmtree(old)


def _remove(path: Path) -> None:
    if path.is_dir():
        shutil.rmtree(path, ignore_errors=True)
    else:
        with contextlib.suppress(OSError):  # a path that cannot be: the first error says why
            path.unlink()
