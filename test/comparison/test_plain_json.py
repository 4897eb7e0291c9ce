from __future__ import annotations

import json
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from truck_blowout_sim.comparison.plain_json import finite_or_none, json_text

JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.text()
    | st.floats(allow_nan=False, allow_infinity=False),
    lambda inner: st.lists(inner) | st.dictionaries(st.text(), inner),
)  # fmt: skip


@given(JSON)
def test_writing_what_was_read_gives_the_same_bytes(content: object) -> None:
    assert json_text(json.loads(json_text(content))) == json_text(content)


@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf, np.float64("nan")])
def test_what_json_has_no_word_for_is_refused_with_its_place(bad: float) -> None:
    with pytest.raises(ValueError, match=r"a\[1\]\.b"):
        json_text({"a": [0.0, {"b": bad}]})
    assert finite_or_none(bad) is None


def test_numpy_is_plain_and_minus_zero_is_zero() -> None:
    content = {"n": np.int64(3), "x": np.float32(0.5), "z": -0.0, "t": np.True_, "v": np.ones(2)}
    assert json.loads(json_text(content)) == {"n": 3, "x": 0.5, "z": 0.0, "t": True, "v": [1, 1]}
    assert "-0" not in json_text(content)


def test_what_is_no_data_is_refused() -> None:
    with pytest.raises(TypeError, match="where: set"):
        json_text({"where": {1}})


def test_an_instant_of_a_unix_clock_keeps_its_microseconds() -> None:
    late, early = 1700000002.730001, 12.345678901234
    content = {"peak_time_s": late, "interval_s": [late, early], "mass_kg": late}
    assert json.loads(json_text(content)) == {
        "peak_time_s": late, "interval_s": [late, 12.3456789], "mass_kg": 1700000003.0}
    assert json_text(json.loads(json_text(content))) == json_text(content)
