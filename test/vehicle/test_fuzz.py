"""Any file at all: it loads, or one line says why not."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import yaml
from hypothesis import given, settings
from hypothesis import strategies as st

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.resources import config_dir
from truck_blowout_sim.vehicle import Packed, load_vehicle, pack

DEFAULT = config_dir() / "vehicles" / "international_9400i_trailmobile.yaml"
LINES = DEFAULT.read_text(encoding="utf-8").splitlines(keepends=True)
TEXT = "".join(LINES)

WORDS = st.one_of(
    st.none(), st.booleans(), st.integers(), st.floats(), st.text(max_size=12), st.dates()
)
TREES = st.recursive(
    WORDS,
    lambda inner: st.one_of(
        st.lists(inner, max_size=3),
        st.dictionaries(
            st.sampled_from(["units", "axles", "tractor", "mass_kg", "value", "source", "x", "1"]),
            inner,
            max_size=4,
        ),
    ),
    max_leaves=12,
)


def loads_or_says_why(path: Path) -> Packed | None:
    """The packed vehicle, or None after a proper refusal."""
    refusal = ""
    try:
        return pack(load_vehicle(path))
    except InputError as error:
        refusal = str(error)
    assert refusal.startswith(str(path))
    assert "\n" not in refusal
    assert len(refusal) < 4000
    return None


def _can_be_driven(truck: Packed | None) -> bool:
    """Whether what was loaded, if anything, has a number everywhere, infinite for `never`."""
    return truck is None or not np.isnan(truck.params).any()


@pytest.fixture(scope="module")
def path(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("fuzz") / "any.yaml"


@settings(deadline=None)
@given(st.binary(max_size=200))
def test_any_bytes(path: Path, content: bytes) -> None:
    path.write_bytes(content)
    assert loads_or_says_why(path) is None


@settings(deadline=None)
@given(st.text(alphabet=st.sampled_from("abx:-{}[]&*!<>|'\"# \n0.,?%@"), max_size=80))
def test_any_yaml_like_text(path: Path, content: str) -> None:
    path.write_text(content, encoding="utf-8")
    assert loads_or_says_why(path) is None


@settings(deadline=None)
@given(TREES)
def test_any_tree_over_the_default(path: Path, tree: object) -> None:
    over = yaml.safe_dump(tree, allow_unicode=True)
    path.write_text(over, encoding="utf-8")
    assert loads_or_says_why(path) is None
    if isinstance(tree, dict):
        path.write_text(f"extends: {DEFAULT.stem}\n{over}", encoding="utf-8")
        assert _can_be_driven(loads_or_says_why(path))


@settings(max_examples=60, deadline=None)
@given(start=st.integers(0, len(LINES)), count=st.integers(1, 30))
def test_lines_torn_out(path: Path, start: int, count: int) -> None:
    path.write_text("".join(LINES[:start] + LINES[start + count :]), encoding="utf-8")
    assert _can_be_driven(loads_or_says_why(path))


@settings(max_examples=60, deadline=None)
@given(end=st.integers(0, len(TEXT) - 200))
def test_a_file_cut_short(path: Path, end: int) -> None:
    path.write_text(TEXT[:end], encoding="utf-8")
    assert loads_or_says_why(path) is None


@settings(deadline=None)
@given(
    key=st.sampled_from(["mass_kg", "x_m", "z_m", "ixx_kgm2", "iyy_kgm2", "izz_kgm2", "ixz_kgm2"]),
    value=st.one_of(st.floats(), st.integers(), st.floats(-9.0, 9.0), st.text(max_size=5)),
)
def test_any_number_in_a_body(path: Path, key: str, value: object) -> None:
    over = yaml.safe_dump({"units": {"tractor": {"body": {key: value}}}})
    path.write_text(f"extends: {DEFAULT.stem}\n{over}", encoding="utf-8")
    packed = loads_or_says_why(path)
    if packed is not None:
        body = packed.vehicle.spec.units.tractor.body
        assert getattr(body, key) == float(value)  # type: ignore[arg-type]
