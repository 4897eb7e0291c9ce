"""Where every number sits in a CDR message, and many messages taken apart at once.

A message of a fixed type with fixed strings and array lengths has every number at a fixed byte.
:func:`walk` finds those bytes once; reading and writing whole series is then plain array work.

References: OMG CDR (XCDR1, plain), as `rmw` implementations write it: 4 bytes of encapsulation,
then each primitive aligned to its own size counted from there.
Known limits: no wide strings, no long doubles; XCDR2 and parameter lists are refused.
Validated with: test/recordings/test_cdr.py, against `rosbags`' own serialisation.
"""

from __future__ import annotations

import struct
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray
from rosbags.interfaces import Nodetype
from rosbags.typesys.store import Typestore

from truck_blowout_sim.recordings.message_types import typestore

HEADER_SIZE = 4
_LITTLE, _BIG = b"\x00\x01", b"\x00\x00"
_SIZES = {
    "bool": 1, "byte": 1, "char": 1, "octet": 1, "int8": 1, "uint8": 1, "int16": 2, "uint16": 2,
    "int32": 4, "uint32": 4, "float32": 4, "int64": 8, "uint64": 8, "float64": 8,
}  # fmt: skip
_CODES = {
    "bool": "u1", "byte": "u1", "char": "u1", "octet": "u1", "int8": "i1", "uint8": "u1",
    "int16": "i2", "uint16": "u2", "int32": "i4", "uint32": "u4", "float32": "f4",
    "int64": "i8", "uint64": "u8", "float64": "f8",
}  # fmt: skip
_LONGEST_SEQUENCE = 100_000
FieldDesc = tuple[Any, Any]


class MalformedMessageError(ValueError):
    """The bytes are not a message of this type; the text says where they go wrong."""


@dataclass
class Layout:
    """Result of :func:`walk`.

    Attributes:
        size: length of the message in bytes.
        byte_order: ``<`` or ``>``.
        numbers: byte and numpy code by field path; array entries as ``path[3]``.
        texts: strings by field path; entries of string lists as ``path[3]``.
        lengths: number of entries by path of each sequence.
        fixed: (start, end) of the bytes that fix this layout: string and sequence lengths, texts.
    """

    size: int
    byte_order: str
    numbers: dict[str, tuple[int, str]] = field(default_factory=dict)
    texts: dict[str, str] = field(default_factory=dict)
    lengths: dict[str, int] = field(default_factory=dict)
    fixed: list[tuple[int, int]] = field(default_factory=list)

    def fixed_mask(self) -> NDArray[np.bool_]:
        """True for bytes that must be equal in another message for it to share this layout."""
        mask = np.zeros(self.size, dtype=np.bool_)
        mask[:2] = True
        for start, end in self.fixed:
            mask[start:end] = True
        return mask


def walk(message: bytes, ros_type: str, store: Typestore | None = None) -> Layout:
    """Locate every field of one serialised message.

    Args:
        message: with its CDR header.
        ros_type: message type.
        store: field lists; those of the standard messages if left out.

    Raises:
        MalformedMessageError: it ends too early, or a length or text in it cannot be.
    """
    order = {_LITTLE: "<", _BIG: ">"}.get(message[:2])
    if order is None:
        raise MalformedMessageError(f"starts with {message[:4].hex(' ')}, not a plain CDR header")
    walker = _Walker(message, order, store or typestore())
    walker.named(ros_type, "")
    return walker.layout


class _Walker:
    def __init__(self, message: bytes, order: str, store: Typestore) -> None:
        self.fields = store.fielddefs
        self.message = message
        self.at = HEADER_SIZE
        self.layout = Layout(len(message), order)

    def named(self, ros_type: str, path: str) -> None:
        for name, kind in self.fields[ros_type][1]:
            self.field(kind, f"{path}.{name}" if path else name)

    def field(self, kind: FieldDesc, path: str) -> None:
        node, detail = kind
        if node == Nodetype.NAME:
            self.named(detail, path)
        elif node == Nodetype.BASE:
            self.primitive(detail[0], path)
        else:
            count = detail[1] if node == Nodetype.ARRAY else self.length(path)
            for index in range(count):
                self.field(detail[0], f"{path}[{index}]")

    def length(self, path: str) -> int:
        start = self.take("uint32", path)
        (count,) = struct.unpack_from(self.layout.byte_order + "I", self.message, start)
        if count > min(_LONGEST_SEQUENCE, len(self.message)):
            raise MalformedMessageError(
                f"{path} claims {count} entries in {len(self.message)} bytes"
            )
        self.layout.fixed.append((start, start + 4))
        self.layout.lengths[path] = count
        return int(count)

    def primitive(self, name: str, path: str) -> None:
        if name == "string":
            self.text(path)
        elif name in _SIZES:
            self.layout.numbers[path] = (self.take(name, path), _CODES[name])
        else:
            raise MalformedMessageError(f"{path} is of type {name}, which is not supported")

    def text(self, path: str) -> None:
        start = self.take("uint32", path)
        (size,) = struct.unpack_from(self.layout.byte_order + "I", self.message, start)
        end = self.at + size
        if end > len(self.message):
            raise MalformedMessageError(f"text {path} ends beyond the message")
        try:
            self.layout.texts[path] = self.message[self.at : max(self.at, end - 1)].decode()
        except UnicodeDecodeError:
            raise MalformedMessageError(f"text {path} is not UTF-8") from None
        self.layout.fixed.append((start, end))
        self.at = end

    def take(self, name: str, path: str) -> int:
        size = _SIZES[name]
        start = HEADER_SIZE + -(-(self.at - HEADER_SIZE) // size) * size
        if start + size > len(self.message):
            raise MalformedMessageError(f"ends at byte {len(self.message)}, before {path}")
        self.at = start + size
        return start


@dataclass(frozen=True)
class Block:
    """Messages of one layout, as rows of bytes.

    Attributes:
        index: positions of these messages in the sequence that was given.
        layout: where their fields are.
        rows: shape (messages, bytes).
    """

    index: NDArray[np.intp]
    layout: Layout
    rows: NDArray[np.uint8]

    def number(self, path: str) -> NDArray[np.float64]:
        """One numeric field of all messages as float64; KeyError if the type lacks it."""
        return self.raw(path).astype(np.float64)

    def raw(self, path: str) -> NDArray[Any]:
        """One numeric field of all messages in its own type."""
        start, code = self.layout.numbers[path]
        size = int(code[1:])
        columns = np.ascontiguousarray(self.rows[:, start : start + size])
        return columns.view(self.layout.byte_order + code)[:, 0]


def blocks(
    messages: Sequence[bytes], ros_type: str, store: Typestore | None = None
) -> Iterator[Block]:
    """Take a series of messages of one type apart, grouped by layout.

    Raises:
        MalformedMessageError: with ``args[1]`` the position of the offending message.
    """
    left = np.arange(len(messages))
    lengths = np.fromiter(map(len, messages), dtype=np.int64, count=len(messages))
    while left.size:
        first = int(left[0])
        try:
            layout = walk(messages[first], ros_type, store)
        except MalformedMessageError as error:
            raise MalformedMessageError(str(error), first) from None
        same = left[lengths[left] == layout.size]
        joined = b"".join([messages[i] for i in same])
        rows = np.frombuffer(joined, dtype=np.uint8).reshape(same.size, layout.size)
        mask = layout.fixed_mask()
        match = (rows[:, mask] == rows[0, mask]).all(axis=1)
        yield Block(same[match], layout, rows[match])
        left = np.setdiff1d(left, same[match], assume_unique=True)


def template(ros_type: str, **fields: object) -> bytes:
    """A message with zeros, identity and empty texts, but for the given fields.

    Args:
        ros_type: message type.
        fields: values by path with ``__`` for the dot: ``header__frame_id="map"``, sequences as
            lists.
    """
    message = _default(ros_type)
    for path, value in fields.items():
        *parents, last = path.split("__")
        holder = message
        for name in parents:
            holder = getattr(holder, name)
        setattr(holder, last, value)
    return bytes(typestore().serialize_cdr(message, ros_type))


def _default(ros_type: str) -> object:
    fields = typestore().fielddefs[ros_type][1]
    values: dict[str, Any] = {name: _default_field(kind) for name, kind in fields}
    if ros_type == "geometry_msgs/msg/Quaternion":
        values["w"] = 1.0
    return typestore().types[ros_type](**values)


def _default_field(kind: FieldDesc) -> object:
    node, detail = kind
    if node == Nodetype.NAME:
        return _default(detail)
    if node == Nodetype.BASE:
        return "" if detail[0] == "string" else 0.0 if detail[0].startswith("float") else 0
    (inner_node, inner), count = detail
    if inner_node == Nodetype.BASE and inner[0] in _CODES:
        return np.zeros(count, dtype=_CODES[inner[0]])
    return []


def blank(ros_type: str) -> object:
    """A message of `rosbags` with zeros, identity and empty texts and sequences, to be filled."""
    return _default(ros_type)
