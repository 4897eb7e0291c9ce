"""``metadata.yaml`` of a rosbag2 folder, version 9: written atomically, read tolerantly.

References: rosbag2 (Kilted) metadata version 9: `offered_qos_profiles` a list,
`type_description_hash`, `custom_data`.
Validated with: test/recordings/test_foreign_readers.py (rosbags).
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import yaml

from truck_blowout_sim.errors import InputError, StorageError, quoted
from truck_blowout_sim.recordings.mcap_file import Contents
from truck_blowout_sim.recordings.message_types import ROS_DISTRO, offered_qos, type_hash

FILE_NAME = "metadata.yaml"
_VERSION = 9
# an impossible date is a ValueError, a thousand brackets are a RecursionError
NOT_YAML = (yaml.YAMLError, ValueError, RecursionError)


class _Plain(yaml.SafeDumper):
    """Writes equal parts out in full: not every reader knows YAML's anchors."""

    def ignore_aliases(self, data: object) -> bool:
        return True


@dataclass(frozen=True)
class BagMetadata:
    """What reading a bag needs from its ``metadata.yaml``.

    Attributes:
        files: data files, relative to the folder.
        message_count: messages that the files should hold.
        custom_data: free text by key.
        storage: ``mcap`` or ``sqlite3``.
        compressed: ``file`` or ``message`` where rosbag2 compressed it, else empty.
    """

    files: tuple[str, ...]
    message_count: int
    custom_data: Mapping[str, str]
    storage: str = "mcap"
    compressed: str = ""

    @property
    def plain_mcap(self) -> bool:
        """Whether the files are MCAP as it is, without rosbag2's own compression around it."""
        return self.storage == "mcap" and not self.compressed

    @property
    def compression(self) -> str:
        """Words for what rosbag2 compressed, empty if it did not."""
        return f", {self.compressed} compressed" if self.compressed else ""


def describe(contents: Contents, file_name: str, custom: Mapping[str, str]) -> dict[str, Any]:
    """The metadata of one MCAP file as the tree that ``metadata.yaml`` holds."""
    span = {
        "starting_time": {"nanoseconds_since_epoch": contents.start_ns},
        "duration": {"nanoseconds": contents.end_ns - contents.start_ns},
        "message_count": contents.message_count,
    }
    topics = [
        {
            "topic_metadata": {
                "name": channel.topic,
                "type": contents.schemas[channel.schema_id].name,
                "serialization_format": "cdr",
                "offered_qos_profiles": _qos_of(channel.topic, channel.metadata),
                "type_description_hash": _hash_of(contents.schemas[channel.schema_id].name),
            },
            "message_count": contents.counts.get(channel.id, 0),
        }
        for channel in contents.channels.values()
    ]
    return {
        "rosbag2_bagfile_information": {
            "version": _VERSION,
            "storage_identifier": "mcap",
            **span,
            "topics_with_message_count": topics,
            "compression_format": "",
            "compression_mode": "",
            "relative_file_paths": [file_name],
            "files": [{"path": file_name, **span}],
            "custom_data": dict(custom),
            "ros_distro": ROS_DISTRO,
        }
    }


def as_yaml(tree: Mapping[str, Any]) -> str:
    """YAML text of a metadata tree."""
    return str(
        yaml.dump(dict(tree), Dumper=_Plain, sort_keys=False, allow_unicode=True, width=10_000)
    )


def write_metadata(folder: Path, tree: Mapping[str, Any]) -> None:
    """Write ``metadata.yaml``: to a temporary file, then renamed.

    Raises:
        StorageError: disk full or no permission; no partial file is left.
    """
    temporary = folder / f".{FILE_NAME}.{os.getpid()}"
    try:
        temporary.write_text(as_yaml(tree), encoding="utf-8")
        os.replace(temporary, folder / FILE_NAME)
    except OSError as error:
        temporary.unlink(missing_ok=True)
        words = f"cannot write: {error.strerror}; the messages are saved"
        raise StorageError(words, file=folder / FILE_NAME, number=error.errno or 5) from error


def read_metadata(folder: Path) -> BagMetadata | None:
    """Read ``metadata.yaml``; None if there is none (a killed recorder leaves none).

    Raises:
        InputError: it is there but is no rosbag2 metadata, or of an unknown storage.
    """
    path = folder / FILE_NAME
    if not path.is_file():
        return None
    expected = "rosbag2 metadata (rosbag2_bagfile_information: …)"
    try:
        tree = yaml.safe_load(path.read_bytes())
    except NOT_YAML as error:
        mark = getattr(error, "problem_mark", None)
        where = f"line {mark.line + 1}" if mark else ""
        raise InputError("is not YAML", file=path, where=where, expected=expected) from None
    info = tree.get("rosbag2_bagfile_information") if isinstance(tree, dict) else None
    if not isinstance(info, dict):
        raise InputError("has no rosbag2_bagfile_information", file=path, expected=expected)
    storage = info.get("storage_identifier")
    if storage not in ("mcap", "sqlite3"):
        raise InputError(f"storage {quoted(storage)}", file=path, where="key storage_identifier",
                         expected="mcap or sqlite3")  # fmt: skip
    mode = str(info.get("compression_mode") or "none").strip().lower()
    if mode not in ("none", "storage", "file", "message"):
        raise InputError(f"compression {quoted(mode)}", file=path, where="key compression_mode",
                         expected="none, file, message or storage")  # fmt: skip
    return BagMetadata(
        _files(info, path), _message_count(info, path), _custom_data(info), str(storage),
        "" if mode in ("none", "storage") else mode,
    )  # fmt: skip


def _files(info: Mapping[str, Any], path: Path) -> tuple[str, ...]:
    files = info.get("relative_file_paths")
    if not isinstance(files, list) or not files or not all(isinstance(f, str) for f in files):
        raise InputError(
            f"value {quoted(files)}",
            file=path,
            where="key relative_file_paths",
            expected="a list of files",
        )
    return tuple(files)


def _message_count(info: Mapping[str, Any], path: Path) -> int:
    count = info.get("message_count")
    if not isinstance(count, int) or isinstance(count, bool) or count < 0:
        raise InputError(
            f"value {quoted(count)}",
            file=path,
            where="key message_count",
            expected="a whole number, 0 or more",
        )
    return count


def _custom_data(info: Mapping[str, Any]) -> dict[str, str]:
    custom = info.get("custom_data")
    return {str(k): str(v) for k, v in custom.items()} if isinstance(custom, dict) else {}


def qos_text(profile: Mapping[str, Any]) -> str:
    """A topic's QoS profile as the YAML text, a list, that MCAP channel metadata holds."""
    return str(yaml.dump([dict(profile)], Dumper=_Plain, sort_keys=False))


def _qos_of(topic: str, channel_metadata: Mapping[str, str]) -> list[Any]:
    text = channel_metadata.get("offered_qos_profiles")
    if text is None:
        return [offered_qos(topic)]
    try:
        profiles = yaml.safe_load(text)
    except NOT_YAML:
        # a foreign recorder's words, only passed on when its file is recovered
        return []
    return profiles if isinstance(profiles, list) else []


def _hash_of(ros_type: str) -> str:
    try:
        return type_hash(ros_type)
    except KeyError:
        return ""
