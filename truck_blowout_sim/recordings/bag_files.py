"""The files of a bag, merged: topics with their messages, metadata, what was odd."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from pathlib import Path

import yaml
from rosbags.typesys.store import Typestore

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings.bag_metadata import (
    FILE_NAME,
    NOT_YAML,
    BagMetadata,
    read_metadata,
)
from truck_blowout_sim.recordings.bag_storages import read_storage
from truck_blowout_sim.recordings.bag_writer import METADATA_NAME
from truck_blowout_sim.recordings.mcap_scan import Scan, Topic, scan
from truck_blowout_sim.recordings.message_types import store_of

_ENTRY = re.compile(r"([a-z][a-z0-9_]*): (.*)", re.DOTALL)


@dataclass
class BagFiles:
    """A bag's content.

    Attributes:
        name: of the folder, or stem of the file.
        topics: messages by absolute topic name.
        metadata: free text by key.
        notes: what a person should know, e.g. that the writer was killed.
        kind: of storage, in words.
        ros1: messages were converted from ROS 1; their types are as the bag defines them.
    """

    name: str
    topics: dict[str, Topic] = field(default_factory=dict)
    metadata: dict[str, str] = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)
    kind: str = "MCAP"
    ros1: bool = False

    def store(self) -> Typestore:
        """Field lists of this bag's types: as it defines them, else the standard ones."""
        return store_of((t.ros_type, t.definition) for t in self.topics.values())


def open_bag(path: Path) -> BagFiles:
    """Read all files of a bag.

    Args:
        path: a rosbag2 folder of any storage and compression, its ``metadata.yaml``, one ``.mcap``
            or ``.db3`` file, or a ROS 1 ``.bag``.

    Raises:
        InputError: no bag, damaged, or cut short.
    """
    if path.name == FILE_NAME:
        path = path.parent
    if path.suffix in (".db3", ".bag"):
        return _through_library(path, path.stem, "ROS 1 bag" if path.suffix == ".bag" else "SQLite")
    if not path.is_dir():
        bag = BagFiles(path.stem)
        _add(bag, scan(path), path)
        bag.metadata = _split_notes(bag.metadata)
        return bag
    described = read_metadata(path)
    if described and not described.plain_mcap:
        kind = described.storage if described.storage == "mcap" else "SQLite"
        bag = _through_library(path, path.resolve().name, kind + described.compression)
        bag.metadata = _split_notes(dict(described.custom_data))
        _check_complete(path, bag, described)
        return bag
    files = _files(path, described)
    bag = BagFiles(path.resolve().name)
    if described:
        bag.metadata.update(described.custom_data)
    else:
        bag.notes.append(f"no {FILE_NAME}: its recorder was not closed; read as far as it goes")
    for file in files:
        _add(bag, scan(file), file)
    _check_complete(path, bag, described)
    bag.metadata = _split_notes(bag.metadata)
    return bag


def _through_library(path: Path, name: str, kind: str) -> BagFiles:
    """Storages that `rosbags` reads for us."""
    bag = BagFiles(name, kind=kind, ros1=path.suffix == ".bag")
    bag.topics = read_storage(path)
    return bag


def _files(folder: Path, described: BagMetadata | None) -> list[Path]:
    if described is None:
        files = sorted(folder.glob("*.mcap"))
        if not files:
            raise InputError(
                "holds neither metadata.yaml nor .mcap files", file=folder, expected="a bag"
            )
        return files
    files = [folder / name for name in described.files]
    for file in files:
        if not file.is_file():
            raise InputError(
                "is missing", file=file, expected=f"the file that {FILE_NAME} beside it lists"
            )
    return files


def _add(bag: BagFiles, part: Scan, file: Path) -> None:
    for topic in part.topics.values():
        name = "/" + topic.name.strip("/")
        held = bag.topics.setdefault(
            name, Topic(name, topic.ros_type, topic.encoding, topic.definition)
        )
        held.require_type(topic.ros_type, file)
        held.log_times_ns += topic.log_times_ns
        held.data += topic.data
    bag.metadata.update(_embedded(part, file))
    if not part.finished:
        lost = part.size - part.good_end
        bag.notes.append(
            f"{file.name} was not closed by its writer: {part.message_count} messages read,"
            f" {lost} bytes of an unfinished chunk left out"
        )
    if not part.message_count and not part.finished:
        raise InputError(
            f"breaks off after {part.size} bytes, before the first whole chunk",
            file=file,
            where=f"byte {part.good_end}",
            expected="an MCAP file with messages",
        )


def _embedded(part: Scan, file: Path) -> dict[str, str]:
    if METADATA_NAME in part.metadata:
        return part.metadata[METADATA_NAME]
    text = part.metadata.get("rosbag2", {}).get("serialized_metadata", "")
    try:
        tree = yaml.safe_load(text)
    except NOT_YAML:
        raise InputError(
            "metadata record rosbag2 is not YAML", file=file, expected="rosbag2 metadata"
        ) from None
    custom = tree.get("custom_data") if isinstance(tree, dict) else None
    return {str(k): str(v) for k, v in custom.items()} if isinstance(custom, dict) else {}


def _check_complete(folder: Path, bag: BagFiles, described: BagMetadata | None) -> None:
    held = sum(len(topic.data) for topic in bag.topics.values())
    if described and held < described.message_count:
        raise InputError(
            f"truncated: holds {held} of {described.message_count} messages",
            file=folder,
            where=f"{FILE_NAME}, key message_count",
            expected="all of them (read the .mcap file itself to use what is left)",
        )


def _split_notes(metadata: dict[str, str]) -> dict[str, str]:
    """Entries that were packed into one text ``a: b; c: d`` as entries of their own."""
    packed = metadata.get("notes", "")
    entries: dict[str, str] = {}
    last = ""
    for piece in packed.split("; "):
        match = _ENTRY.fullmatch(piece)
        if match:
            last = match[1]
            entries[last] = match[2]
        elif last:
            entries[last] += "; " + piece
        else:
            return metadata
    return {**entries, **{k: v for k, v in metadata.items() if k != "notes"}}
