"""MDF 3 and 4, as CAN loggers write them, read by `mdf_decoder` in a process of its own.

References: ASAM MDF 3.3 and 4.2.
Known limits: those of `mdf_decoder`; starting its process takes about a second.
Validated with: test/recordings/test_logs_binary.py.
"""

from __future__ import annotations

import contextlib
import os
import pickle
import signal
import subprocess
import sys
import weakref
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings.logs.log import Column, find_name
from truck_blowout_sim.recordings.logs.mdf_decoder import EXPECTED, Contents

_START = (
    "import sys; sys.path[:] = sys.argv[2:]; "
    "from truck_blowout_sim.recordings.logs.mdf_decoder import serve; serve(sys.argv[1])"
)
_PATIENCE_S = 5.0  # for a process that closed its pipe to end


class _Decoder:
    """The process that reads one file; ends with this object.

    It has the caller's `sys.path`, never its `__main__`; a session of its own, so that Ctrl-C comes
    to the caller alone; and a temporary folder, as what asammdf puts there survives a crash.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        folder = TemporaryDirectory(prefix="truck_blowout_sim_")
        self._process = subprocess.Popen(
            [sys.executable, "-c", _START, str(path), *sys.path],
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
            start_new_session=True, env={**os.environ, "TMPDIR": folder.name},
        )  # fmt: skip
        weakref.finalize(self, _end, self._process, folder)

    def answer(self, name: str | None = None) -> Any:  # noqa: ANN401 -- of the kind that is asked for
        """The contents, which come first and unasked, or the named column.

        Raises:
            InputError: the decoder's own, or it ended without an answer.
        """
        requests, answers = self._process.stdin, self._process.stdout
        assert requests is not None
        assert answers is not None
        try:
            if name is not None:
                pickle.dump(name, requests)
                requests.flush()
            found = pickle.load(answers)
        except Exception:  # noqa: BLE001 -- a pipe that broke, or a pickle cut anywhere
            where = "" if name is None else f"channel {name}"
            raise InputError(f"damaged: {_last_words(self._process)}", file=self.path,
                             where=where, expected=EXPECTED) from None  # fmt: skip
        except BaseException:
            self._process.kill()  # its late answer must not be taken for that of the next request
            raise
        if isinstance(found, InputError):
            raise found
        return found


def _last_words(process: subprocess.Popen[bytes]) -> str:
    try:
        status = process.wait(_PATIENCE_S)
    except subprocess.TimeoutExpired:
        return "its decoder gave no answer"
    if status < 0:
        return f"its decoder ended by signal {-status} ({signal.strsignal(-status)})"
    return f"its decoder ended without an answer (status {status})"


def _end(process: subprocess.Popen[bytes], folder: TemporaryDirectory[str]) -> None:
    process.kill()
    process.wait()
    for pipe in (process.stdin, process.stdout):
        with contextlib.suppress(OSError):  # a request that nobody read
            if pipe is not None:
                pipe.close()
    folder.cleanup()


@dataclass
class MdfLog:
    """An open MDF file; channels are read when they are asked for.

    Attributes:
        start_s: instant of time stamp 0, since 1970; None if the file does not tell it.
    """

    path: Path
    kind: str
    names: Sequence[str]
    decoder: _Decoder
    start_s: float | None = None
    notes: list[str] = field(default_factory=list)
    metadata: dict[str, str] = field(default_factory=dict)

    def find(self, name: str) -> str | None:
        """The channel itself, but for case."""
        return find_name(name, self.names)

    def column(self, name: str) -> Column:
        """Read one channel with the time stamps of its group.

        Raises:
            InputError: damaged.
        """
        column: Column = self.decoder.answer(name)
        return column


def open_mdf(path: Path) -> MdfLog:
    """Open an MDF file.

    Raises:
        InputError: asammdf is not installed; no MDF file, or damaged.
    """
    with path.open("rb") as head:
        if head.read(3) not in (b"MDF", b"UnF"):
            raise InputError("begins with other bytes than MDF", file=path, expected=EXPECTED)
    decoder = _Decoder(path)
    contents: Contents = decoder.answer()
    return MdfLog(path, f"MDF {contents.version}", list(contents.names), decoder, contents.start_s,
                  metadata={"log_start": contents.log_start} if contents.log_start else {})
