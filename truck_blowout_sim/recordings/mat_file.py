"""Numeric variables of a MATLAB file, read without trusting a byte of it.

`scipy.io.loadmat` crashes the interpreter on some damaged files (segmentation fault), so the
little that is needed is read here: real numeric arrays, texts, and what structures and cells hold
of them, of MATLAB 5 to 7.2 files.

References: MathWorks, MAT-File Format (level 5): header, data elements, array subelements.
Known limits: no MATLAB 4; 7.3 is HDF5 and read elsewhere; objects (table, timetable,
timeseries) are only named.
Validated with: test/recordings/test_mat_format.py, against `scipy.io.savemat`, fuzzed.
"""

from __future__ import annotations

import math
import struct
import zlib
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.errors import InputError

_HEADER_SIZE = 128
_MATRIX, _COMPRESSED = 14, 15
_LARGEST = 1 << 30
_NUMBERS = {1: "i1", 2: "u1", 3: "i2", 4: "u2", 5: "i4", 6: "u4", 7: "f4", 9: "f8", 12: "i8",
            13: "u8"}  # fmt: skip
_CLASSES = {1: "a cell array", 2: "a structure", 3: "an object", 4: "a text", 5: "a sparse array"}
_FIRST_NUMERIC_CLASS, _LAST_NUMERIC_CLASS = 6, 15
_CELL_CLASS, _STRUCTURE_CLASS, _TEXT_CLASS, _OBJECT_CLASS = 1, 2, 4, 17
_COMPLEX_FLAG = 0x0800
_DEEPEST = 12
_MOST_VARIABLES = 20_000
_EXPECTED = "an undamaged MATLAB file of version 5 to 7.2 (save with -v7)"


class _DamagedError(ValueError):
    """The element contradicts itself."""


@dataclass(frozen=True)
class Variable:
    """A variable: its numbers, its text, or what it is instead."""

    name: str
    values: NDArray[np.float64] | None
    kind: str
    text: str = ""
    inside: tuple[Variable, ...] = ()

    def flat(self, prefix: str = "") -> Iterator[tuple[str, Variable]]:
        """This variable and all inside it, named by path: ``log.speed``, ``cells{2}``."""
        name = f"{prefix}{self.name}"
        yield name, self
        for part in self.inside:
            dot = "" if part.name.startswith(("{", "(")) else "."
            yield from part.flat(name + dot)


def read_variables(path: Path) -> dict[str, Variable]:
    """All variables of a file, by name.

    Raises:
        InputError: not a MATLAB file of these versions, or damaged, or cut short.
    """
    data = path.read_bytes()
    order = _byte_order(path, data)
    found = {}
    at = _HEADER_SIZE
    while at < len(data):
        try:
            kind, start, end, following = _element(data, at, order)
            content = data[start:end]
            if kind == _COMPRESSED:
                kind, content = _unpacked(content, order)
            if kind == _MATRIX:
                variable = _variable(content, order)
                found[variable.name] = variable
        except (_DamagedError, struct.error, zlib.error, UnicodeDecodeError) as error:
            raise InputError(
                f"damaged: {error}", file=path, where=f"byte {at}", expected=_EXPECTED
            ) from None
        at = following
    return found


def _byte_order(path: Path, data: bytes) -> str:
    if data.startswith(b"MATLAB 7.3"):
        raise InputError("is MATLAB 7.3 (HDF5)", file=path, expected="a file saved with -v7")
    order = {b"IM": "<", b"MI": ">"}.get(data[_HEADER_SIZE - 2 : _HEADER_SIZE])
    if order is None:
        found = f"begins with {data[:8].hex(' ')}" if data else "is empty"
        raise InputError(found, file=path, where="byte 0", expected=_EXPECTED)
    return order


def _element(data: bytes, at: int, order: str) -> tuple[int, int, int, int]:
    """Kind, start and end of content, and start of the next element."""
    if at + 8 > len(data):
        raise _DamagedError(f"cut short, {len(data) - at} bytes where an element begins")
    kind, size = struct.unpack_from(order + "II", data, at)
    if kind >> 16:
        # small elements keep their size in the upper half and their content beside it
        kind, size, start, following = kind & 0xFFFF, kind >> 16, at + 4, at + 8
        if size > 4:
            raise _DamagedError(f"a small element of {size} bytes")
        return kind, start, start + size, following
    start, end = at + 8, at + 8 + size
    if end > len(data):
        raise _DamagedError(f"cut short, {end - len(data)} bytes are missing")
    following = end if kind == _COMPRESSED else end + -size % 8
    return kind, start, end, following


def _unpacked(content: bytes, order: str) -> tuple[int, bytes]:
    unpacker = zlib.decompressobj()
    data = unpacker.decompress(content, _LARGEST)
    if not unpacker.eof:
        raise _DamagedError("a compressed element does not end")
    kind, start, end, _ = _element(data, 0, order)
    return kind, data[start:end]


def _parts(content: bytes, order: str) -> Iterator[tuple[int, bytes]]:
    at = 0
    while at < len(content):
        kind, start, end, at = _element(content, at, order)
        yield kind, content[start:end]


def _variable(content: bytes, order: str, depth: int = 0) -> Variable:
    if depth > _DEEPEST:
        raise _DamagedError(f"structures nested more than {_DEEPEST} deep")
    parts = _parts(content, order)
    try:
        (flags,) = struct.unpack_from(order + "I", next(parts)[1])
        array_class = flags & 0xFF
        if array_class == _OBJECT_CLASS:
            return _object(parts)
        shape = np.frombuffer(next(parts)[1], dtype=order + "i4").astype(np.int64)
        name = next(parts)[1].decode("ascii")
        if array_class in (_CELL_CLASS, _STRUCTURE_CLASS):
            inside = _inside(array_class, shape, parts, order, depth)
            return Variable(name, None, _CLASSES[array_class], inside=inside)
        if array_class == _TEXT_CLASS:
            return Variable(name, None, _CLASSES[array_class], _text(shape, *next(parts), order))
        if not _FIRST_NUMERIC_CLASS <= array_class <= _LAST_NUMERIC_CLASS:
            return Variable(name, None, _CLASSES.get(array_class, f"of class {array_class}"))
        if flags & _COMPLEX_FLAG:
            return Variable(name, None, "complex")
        kind, numbers = next(parts)
    except StopIteration:
        raise _DamagedError("an array without all its parts") from None
    except ValueError as error:
        raise _DamagedError(str(error)) from None
    return _numeric(name, shape, kind, numbers, order)


def _object(parts: Iterator[tuple[int, bytes]]) -> Variable:
    """Name and class of a MATLAB object; its content is in a form that MathWorks does not publish.

    Name, type system ("MCOS") and class stand as texts.
    """
    name = next(parts)[1].decode("ascii")
    next(parts, None)
    _, packed = next(parts, (0, b""))
    return Variable(name, None, f"an object{f' of class {c}' if (c := _word(packed)) else ''}")


def _word(packed: bytes) -> str:
    text = packed.split(b"\0")[0].decode("ascii", "replace")
    return text if text.isidentifier() else ""


def _inside(
    array_class: int, shape: NDArray[np.int64], parts: Iterator[tuple[int, bytes]], order: str,
    depth: int,
) -> tuple[Variable, ...]:
    """Entries of a cell array, or fields of a structure (of each entry of a structure array)."""
    count = math.prod(shape.tolist())
    if (shape < 0).any() or count > _MOST_VARIABLES:
        raise _DamagedError(f"{count} entries in one array")
    fields = [""]
    if array_class == _STRUCTURE_CLASS:
        (width,) = struct.unpack_from(order + "i", next(parts)[1])
        packed = next(parts)[1]
        if width <= 0 or len(packed) % width:
            raise _DamagedError(f"field names of {width} bytes in {len(packed)}")
        cut = (packed[at : at + width] for at in range(0, len(packed), width))
        fields = [piece.split(b"\0")[0].decode("ascii") for piece in cut]
    found = []
    for entry in range(count):
        for field in fields:
            _, content = next(parts)
            held = _variable(content, order, depth + 1) if content else Variable("", None, "empty")
            found.append(replace(held, name=_name_inside(field, entry, count)))
    return tuple(found)


def _name_inside(field: str, entry: int, count: int) -> str:
    if not field:
        return f"{{{entry + 1}}}"
    return field if count == 1 else f"({entry + 1}).{field}"


def _text(shape: NDArray[np.int64], kind: int, content: bytes, order: str) -> str:
    # MATLAB writes 16 bit units, scipy UTF-8; rows of a matrix of letters are joined by a line end
    if kind in (16, 1, 2):
        return content.decode("utf-8", "replace")
    coding = {17: "utf-16", 4: "utf-16", 18: "utf-32"}.get(kind)
    if coding is None:
        raise _DamagedError(f"text of unknown type {kind}")
    return content.decode(f"{coding}-{'le' if order == '<' else 'be'}", "replace")


def _numeric(
    name: str, shape: NDArray[np.int64], kind: int, numbers: bytes, order: str
) -> Variable:
    if kind not in _NUMBERS:
        raise _DamagedError(f"numbers of unknown type {kind}")
    dtype = np.dtype(order + _NUMBERS[kind])
    count = len(numbers) // dtype.itemsize
    if (shape < 0).any() or math.prod(shape.tolist()) != count:
        raise _DamagedError(f"{name} is {shape.tolist()} with {count} numbers")
    values = np.frombuffer(numbers, dtype=dtype, count=count).astype(np.float64)
    text = " x ".join(str(n) for n in shape.tolist())
    return Variable(name, values.reshape(shape.tolist(), order="F"), f"{text} numbers")
