"""JSON that any program can read, with the same bytes for the same content.

Numbers keep ten significant digits: more would be rounding noise of the machine that computed
them, and would make two equal answers look different. Times (keys that end in ``_s``) keep their
microseconds however long ago their clock began.

Validated with: test/comparison/test_plain_json.py.
"""

from __future__ import annotations

import json
import math
import re
from collections.abc import Mapping, Sequence
from typing import TypeAlias

import numpy as np

Json: TypeAlias = "bool | int | float | str | list[Json] | dict[str, Json] | None"
_DIGITS = 10
_TIME = re.compile(r"_s(\[\d+\])*$")  # the place of a time, or of one in a list
_MICROSECONDS = 6  # decimals
_LATE_S = 10.0**(_DIGITS - _MICROSECONDS)  # from here on ten digits hold no microseconds


def json_text(content: object) -> str:
    """Text of a JSON file, ending in a newline; keys keep their order.

    Args:
        content: mappings, sequences, numbers (numpy's too), strings, booleans, None.

    Raises:
        ValueError: a number is NaN or infinite; says where. JSON has no word for either.
        TypeError: something JSON cannot hold.
    """
    return json.dumps(_plain(content, ""), indent=2, ensure_ascii=False, allow_nan=False) + "\n"


def finite_or_none(value: float | None) -> float | None:
    """The number, or ``None`` (JSON's null) where it is absent, open or not computable."""
    return None if value is None or not math.isfinite(value) else float(value)


def _plain(content: object, where: str) -> Json:
    if content is None or isinstance(content, (bool, str)):
        return content
    if isinstance(content, np.bool_):
        return bool(content)
    if isinstance(content, (int, np.integer)):
        return int(content)
    if isinstance(content, (float, np.floating)):
        return _rounded(float(content), where)
    if isinstance(content, Mapping):
        return {str(key): _plain(value, f"{where}.{key}") for key, value in content.items()}
    if isinstance(content, (Sequence, np.ndarray)):
        return [_plain(value, f"{where}[{i}]") for i, value in enumerate(content)]
    raise TypeError(f"{where.lstrip('.')}: {type(content).__name__} does not go into JSON")


def _rounded(value: float, where: str) -> float:
    if not math.isfinite(value):
        raise ValueError(f"{where.lstrip('.') or 'number'} is {value}, which JSON cannot hold")
    if abs(value) >= _LATE_S and _TIME.search(where):
        return round(value, _MICROSECONDS)
    rounded = float(f"{value:.{_DIGITS}g}")
    # adding zero turns -0.0 into 0.0; the largest floats would round up to infinity
    return rounded + 0.0 if math.isfinite(rounded) else value
