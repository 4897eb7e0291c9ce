"""The bag inside the simulator: what was published and what was received, in simulation time.

Writing happens in the bag writer's own thread; a full disk ends the bag, not the simulation.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from datetime import datetime
from pathlib import Path
from typing import Any

from truck_blowout_sim.errors import InputError, StorageError
from truck_blowout_sim.nodes.clock import NS
from truck_blowout_sim.recordings.bag_writer import BagWriter
from truck_blowout_sim.recordings.recording import INPUTS_KEY


class Recorder:
    """Starts and stops bags, and never raises while the simulation runs.

    Args:
        report: called with (level, sentence) for the log; level is "info" or "error".
        metadata: free text for every bag.
        folder: where relative paths begin.
    """

    def __init__(
        self,
        report: Callable[[str, str], None],
        metadata: Mapping[str, str],
        folder: Path,
    ) -> None:
        self._report = report
        self.folder = folder
        self._metadata = {INPUTS_KEY: "held until the next message", "noise": "none", **metadata}
        self._qos: dict[str, Mapping[str, Any]] = {}
        self._bag: BagWriter | None = None
        self._wanted = ""
        self._failed = ""

    def offered(self, topic: str, qos: Mapping[str, Any]) -> None:
        """Say with which QoS profile an absolute topic is published or read."""
        self._qos[topic] = qos

    @property
    def active(self) -> bool:
        """Whether a bag is open and taking messages."""
        return self._bag is not None

    @property
    def state(self) -> dict[str, str]:
        """For the diagnostics: path, messages, bytes, dropped, error."""
        if self._bag is None:
            return {"recording": "no", "error": self._failed}
        state = self._bag.state
        return {
            "recording": "yes",
            "path": str(self._bag.path),
            "messages": str(state.messages),
            "bytes_on_disk": str(state.bytes_on_disk),
            "dropped": str(state.dropped),
            "error": state.error,
        }

    @property
    def error(self) -> str:
        """What went wrong with the present bag, or with the last one; empty if nothing."""
        return (self._bag.state.error if self._bag else "") or self._failed

    @property
    def wanted(self) -> str:
        """The path that was asked for the open bag; empty without one, or for a name by date."""
        return self._wanted if self._bag is not None else ""

    def start(self, wanted: str) -> tuple[bool, str]:
        """Open a bag.

        Args:
            wanted: path; empty: a name with the date, in the working folder.

        Returns:
            Success, and a sentence.
        """
        if self._bag is not None:
            same = wanted in ("", self._wanted)
            words = f"already recording to {self._bag.path}"
            return same, words if same else f"{words}: stop it first"
        name = wanted or datetime.now().strftime("truck_%Y_%m_%d-%H_%M_%S")
        try:
            path = free_path(self.folder / name)
            # the writer flushes at half of this: a kill costs half a second
            self._bag = BagWriter(
                path, metadata=self._metadata, qos=self._qos, raise_errors=False, flush_s=1.0
            )
        except (InputError, StorageError, OSError) as error:
            self._failed = str(error)
            self._report("error", f"cannot record: {error}")
            return False, f"cannot record: {error}"
        self._failed, self._wanted = "", wanted
        self._report("info", f"recording to {path}")
        return True, f"recording to {path}"

    def stop(self) -> tuple[bool, str]:
        """Close the bag; says how much it holds."""
        if self._bag is None:
            return True, "was not recording"
        bag, self._bag = self._bag, None
        try:
            bag.close()
        except StorageError as error:
            self._failed = str(error)
        self._failed = self._failed or bag.state.error
        words = f"recorded {bag.state.messages} messages to {bag.path}"
        if self._failed:
            words += f"; {self._failed}"
        self._report("error" if self._failed else "info", words)
        return not self._failed, words

    def write(self, topic: str, ros_type: str, now_ns: int, data: bytes) -> None:
        """Take one serialised message, absolute topic, stamp in simulated nanoseconds."""
        if self._bag is not None:
            self._bag.message(topic, ros_type, now_ns / NS, data)

    def look_after(self) -> None:
        """Close a bag whose disk failed; called once in a while."""
        if self._bag is not None and self._bag.state.error:
            self.stop()


def check_inside(folder: Path, wanted: str) -> None:
    """Other nodes may have bags written below one folder only.

    Raises:
        InputError: the path leads elsewhere, also by `..` or by a link, is the folder itself, or
            is no path that the system has.
    """
    try:
        target, whole = (folder / wanted).resolve(), folder.resolve()
        target.exists()
    except (OSError, RuntimeError, ValueError) as error:
        raise _refused(f"{error}") from error
    if wanted and (target == whole or not target.is_relative_to(whole)):
        raise _refused(f"{target} does not lie under {folder}")


def _refused(words: str) -> InputError:
    return InputError(
        words, file="parameter", where="record_path",
        expected="a path under record_folder, which is set when the simulator is started",
    )  # fmt: skip


def free_path(path: Path) -> Path:
    """The path itself, or with the first number that is free: `run`, `run_2`, `run_3`."""
    candidate, number = path, 1
    while candidate.exists() and not _empty_folder(candidate):
        number += 1
        candidate = path.with_name(f"{path.stem}_{number}{path.suffix}")
    return candidate


def _empty_folder(path: Path) -> bool:
    return path.is_dir() and not any(path.iterdir())
