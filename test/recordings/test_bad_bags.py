"""Bags that are wrong: one line with file, place, value and what was expected."""

from __future__ import annotations

import random
import shutil
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import yaml
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings import BagWriter, Recording, read_recording, write_recording
from truck_blowout_sim.recordings.cdr import template
from truck_blowout_sim.recordings.mcap_file import MAGIC
from truck_blowout_sim.recordings.recover import recover

FLOAT64 = "std_msgs/msg/Float64"
PRESSURE = "sensor_msgs/msg/FluidPressure"
ODOMETRY = "nav_msgs/msg/Odometry"
IN_TMP = settings(
    suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=60, deadline=None
)


def refusal(path: Path) -> str:
    """The error's line, empty if the file was accepted; any other exception passes."""
    try:
        read_recording(path)
    except InputError as error:
        return str(error)
    return ""


def pressure(pascal: float) -> bytes:
    return template(PRESSURE, fluid_pressure=pascal)


def quaternion(**fields: float) -> bytes:
    return template(ODOMETRY, **{f"pose__pose__orientation__{k}": v for k, v in fields.items()})


MESSAGES: dict[str, tuple[str, str, bytes, str]] = {
    "nan": ("throttle", FLOAT64, template(FLOAT64, data=np.nan), "throttle is nan"),
    "infinite": ("tractor/odometry", ODOMETRY,
                 template(ODOMETRY, twist__twist__linear__x=np.inf), "tractor_vx_mps is inf"),
    "out of range": ("throttle", FLOAT64, template(FLOAT64, data=7.0), "throttle is 7.0"),
    "negative pressure": ("tires/steer_left/pressure", PRESSURE, pressure(-5.0),
                          "tire_pressure_steer_left_pa is -101330.0"),
    "gauge for absolute": ("tires/steer_left/pressure", PRESSURE, pressure(20.0), "-101305"),
    "unknown tire": ("blowout", "std_msgs/msg/String",
                     template("std_msgs/msg/String", data="steer_lefft"), "'steer_lefft'"),
    "no tire": ("blowout", "std_msgs/msg/String", template("std_msgs/msg/String"), "unknown tire"),
    "wrong type": ("throttle", "std_msgs/msg/Int32",
                   template("std_msgs/msg/Int32"), "expected std_msgs/msg/Float64"),
    "short message": ("throttle", FLOAT64, b"\x00\x01\x00\x00\x01\x02", "ends at byte 6"),
    "no CDR": ("throttle", FLOAT64, b"12345678", "not a plain CDR header"),
    "orientation without length": ("tractor/odometry", ODOMETRY, quaternion(w=0.0),
                                   "unit quaternion"),
}  # fmt: skip


@pytest.mark.parametrize("case", MESSAGES)
def test_a_bad_message_is_named_with_topic_and_place(tmp_path: Path, case: str) -> None:
    topic, ros_type, data, words = MESSAGES[case]
    path = tmp_path / "bad.mcap"
    with BagWriter(path, background=False) as writer:
        writer.message(topic, ros_type, 1.5, data)
    line = refusal(path)
    assert words in line
    assert "bad.mcap" in line
    assert topic in line
    assert "expected" in line
    assert "\n" not in line


def test_stamps_that_run_backwards(tmp_path: Path) -> None:
    path = tmp_path / "reset.mcap"
    with BagWriter(path, background=False) as writer:
        for i, second in enumerate((1, 2, 1)):
            message = template(ODOMETRY, header__stamp__sec=second)
            writer.message("tractor/odometry", ODOMETRY, 1 + 0.1 * i, message)
    assert "stamp 1.0 s after 2.0 s" in refusal(path)


def test_no_topic_of_the_truck(tmp_path: Path) -> None:
    path = tmp_path / "camera.mcap"
    with BagWriter(path, background=False) as writer:
        writer.message("/camera/info", FLOAT64, 0.0, template(FLOAT64))
    assert "/camera/info" in refusal(path)
    assert "remapping" in refusal(path)


def edited(folder: Path, change: Callable[[dict[str, object]], object]) -> Path:
    path = folder / "metadata.yaml"
    tree = yaml.safe_load(path.read_text())
    change(tree["rosbag2_bagfile_information"])
    path.write_text(yaml.safe_dump(tree))
    return folder


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda info: info.update(storage_identifier="sqlite3"), "not a database"),
        (lambda info: info.update(storage_identifier="tape"), "tape"),
        (lambda info: info.update(relative_file_paths=["gone.mcap"]), "is missing"),
        (lambda info: info.update(relative_file_paths=3), "relative_file_paths"),
        (lambda info: info.update(message_count="many"), "'many'"),
        (lambda info: info.update(message_count=10**6), "truncated"),
        (lambda info: info["custom_data"].update(time_origin_s="noon"), "'noon'"),
        (lambda info: info.update(compression_mode="SQUEEZE"), "compression"),
    ],
)
def test_wrong_metadata(
    tmp_path: Path,
    sparse_recording: Recording,
    change: Callable[[dict[str, object]], object],
    words: str,
) -> None:
    bag = edited(write_recording(sparse_recording, tmp_path / "bag"), change)
    if words == "'noon'":
        # the file itself knows better than its edited companion: take that away too
        (bag / "bag_0.mcap").write_bytes(
            (bag / "bag_0.mcap").read_bytes().replace(b"-4.92", b"noon!")
        )
    assert words.strip("'") in refusal(bag)


@pytest.mark.parametrize(
    "text",
    ["", "- 1", "a: [", "rosbag2_bagfile_information: 7", "\x00", "a: 2001-99-99", "[" * 1200],
)
def test_metadata_that_is_none(tmp_path: Path, sparse_recording: Recording, text: str) -> None:
    bag = write_recording(sparse_recording, tmp_path / "bag")
    (bag / "metadata.yaml").write_text(text)
    assert "metadata.yaml" in refusal(bag)


def test_folders_and_names_that_are_no_recording(tmp_path: Path) -> None:
    (tmp_path / "empty").mkdir()
    (tmp_path / "x.mcap").write_bytes(b"")
    (tmp_path / "y.mcap").write_bytes(b"hello, I am a text")
    (tmp_path / "z.txt").write_text("x")
    assert "neither" in refusal(tmp_path / "empty")
    assert "is empty" in refusal(tmp_path / "x.mcap")
    assert "begins with" in refusal(tmp_path / "y.mcap")
    assert "--map" in refusal(tmp_path / "z.txt")
    (tmp_path / "z.docx").write_text("x")
    assert ".mat" in refusal(tmp_path / "z.docx")
    assert "no such file" in refusal(tmp_path / "nothing")


@pytest.fixture(scope="module")
def small_bag(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    path = tmp_path_factory.mktemp("small") / "small.mcap"
    with BagWriter(path, background=False) as writer:
        writer.blowout(0.0, "steer_left")
        for i in range(20):
            values = {"throttle": 0.3, "tractor_vx_mps": 20.0, "hub_speed_steer_left_radps": 40.0}
            writer.write(0.1 * i, values)
    return path.read_bytes()


@IN_TMP
@given(seed=st.integers(0, 2**32), changes=st.integers(1, 6))
def test_flipped_bytes_give_a_recording_or_one_line(
    tmp_path: Path, small_bag: bytes, seed: int, changes: int
) -> None:
    data = bytearray(small_bag)
    dice = random.Random(seed)
    for _ in range(changes):
        data[dice.randrange(8, len(data))] = dice.randrange(256)
    path = tmp_path / "flipped.mcap"
    path.write_bytes(data)
    assert "\n" not in refusal(path)
    output = tmp_path / "saved.mcap"
    try:
        recover(path, output)
    except InputError:
        assert not output.exists()
    else:
        output.unlink()


@IN_TMP
@given(st.binary(max_size=300))
def test_random_bytes_are_refused_in_one_line(tmp_path: Path, data: bytes) -> None:
    path = tmp_path / "random.mcap"
    path.write_bytes(MAGIC + data)
    line = refusal(path)
    assert "random.mcap" in line
    assert "\n" not in line


def test_an_uncompressed_bomb_is_refused(tmp_path: Path, small_bag: bytes) -> None:
    """A chunk that announces more memory than anyone has."""
    at = small_bag.index(b"zstd") - 4 - 4 - 8
    data = small_bag[:at] + (1 << 60).to_bytes(8, "little") + small_bag[at + 8 :]
    path = tmp_path / "bomb.mcap"
    path.write_bytes(data)
    assert "cannot be" in refusal(path)


def test_a_failed_import_leaves_nothing_behind(tmp_path: Path, sparse_recording: Recording) -> None:
    bag = write_recording(sparse_recording, tmp_path / "bag")
    shutil.copy(bag / "bag_0.mcap", tmp_path / "old.mcap")
    broken = Recording("broken", {"no_such_channel": sparse_recording["tractor_x_m"]})
    for target in ("bag", "old.mcap", "new", "new.mcap", "new.csv"):
        with pytest.raises(KeyError):
            write_recording(broken, tmp_path / target)
    assert sorted(p.name for p in tmp_path.iterdir()) == ["bag", "old.mcap"]
    assert refusal(bag) == refusal(tmp_path / "old.mcap") == ""
