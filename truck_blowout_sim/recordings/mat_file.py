"""Numeric variables of a MATLAB file, read without trusting a byte of it.

`scipy.io.loadmat` crashes the interpreter on some damaged files (segmentation fault), so the
little that is needed is read here: real numeric arrays of MATLAB 5 to 7.2 files.

References: MathWorks, MAT-File Format (level 5): header, data elements, array subelements.
Known limits: no MATLAB 4, no 7.3 (HDF5); cells, structures and texts are only named.
Validated with: test/recordings/test_mat_format.py, against `scipy.io.savemat`, fuzzed.
"""

from __future__ import annotations

import math
import struct
import zlib
from collections.abc import Iterator
from dataclasses import dataclass
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
_COMPLEX_FLAG = 0x0800
_EXPECTED = "an undamaged MATLAB file of version 5 to 7.2 (save with -v7)"


class _DamagedError(ValueError):
    """The element contradicts itself."""


@dataclass(frozen=True)
class Variable:
    """A variable: its numbers, or what it is instead."""

    name: str
    values: NDArray[np.float64] | None
    kind: str


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


def _variable(content: bytes, order: str) -> Variable:
    parts = _parts(content, order)
    try:
        (flags,) = struct.unpack_from(order + "I", next(parts)[1])
        shape = np.frombuffer(next(parts)[1], dtype=order + "i4").astype(np.int64)
        name = next(parts)[1].decode("ascii")
        array_class = flags & 0xFF
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
