"""The streaming writer: killed, starved of disk, fast, and honest about its state."""

from __future__ import annotations

import errno
import os
import pickle
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from mcap.exceptions import McapError
from mcap.reader import make_reader
from mcap.stream_reader import StreamReader
from rosbags.rosbag2 import Reader

from truck_blowout_sim.errors import InputError, StorageError
from truck_blowout_sim.recordings import BagWriter, channels_for, read_recording
from truck_blowout_sim.recordings.atomic import replacing
from truck_blowout_sim.recordings.mcap_file import storage_error
from truck_blowout_sim.recordings.mcap_scan import scan
from truck_blowout_sim.recordings.recover import recover

ENDLESS = """
import sys, time
from truck_blowout_sim.recordings import BagWriter, channels_for
names = [c.name for c in channels_for() if c.place]
start = time.monotonic()
writer = BagWriter(sys.argv[1])
stream = writer.stream(names)
writer.blowout(0.0, "steer_left")
while True:
    now = time.monotonic() - start
    stream.write(now, [0.1 + 1e-3 * i + 1e-2 * now for i in range(len(names))])
    print(now, flush=True)
    time.sleep(0.005)
"""

FULL_DISK = """
import resource, signal, sys
from truck_blowout_sim.errors import StorageError
from truck_blowout_sim.recordings import BagWriter
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
resource.setrlimit(resource.RLIMIT_FSIZE, (200_000, 200_000))
writer = BagWriter(sys.argv[1], background=False, raise_errors=sys.argv[2] == "raise")
stream = writer.stream(["tractor_x_m", "throttle"])
import random
random.seed(1)
try:
    for i in range(60_000):
        stream.write(0.01 * i, [random.random(), random.random()])
    writer.close()
    print(writer.state)
except StorageError as error:
    print("refused:", error)
    try:
        writer.close()
    except StorageError:
        pass
"""


def killed(path: Path, after_s: float = 2.5) -> float:
    """Let a process write, kill it without warning; time of the last sample it wrote."""
    process = subprocess.Popen([sys.executable, "-c", ENDLESS, str(path)],
                               stdout=subprocess.PIPE, text=True)  # fmt: skip
    assert process.stdout is not None
    first = process.stdout.readline()
    assert first, "the writer did not start"
    time.sleep(after_s)
    os.kill(process.pid, signal.SIGKILL)
    rest = process.stdout.read()
    process.wait()
    return float(rest.strip().splitlines()[-1])


def test_after_kill_9_all_but_the_last_second_is_read_without_recovery(tmp_path: Path) -> None:
    bag = tmp_path / "bag"
    last_s = killed(bag)
    assert last_s > 2.0
    recording = read_recording(bag)
    assert recording.end_s > last_s - 1.0
    assert recording.blowouts[0].tires == ("steer_left",)
    assert len(recording.channels) == len([c for c in channels_for() if c.place])
    assert any("not closed" in note for note in recording.notes)
    with pytest.raises(McapError), (bag / "bag_0.mcap").open("rb") as file:
        list(make_reader(file).iter_messages())

    saved = recover(bag)
    again = read_recording(bag)
    assert again.notes == ()
    assert dict(again.channels) == dict(recording.channels)
    with (bag / "bag_0.mcap").open("rb") as file:
        assert len(list(make_reader(file, validate_crcs=True).iter_messages())) == saved.messages
    with Reader(bag) as reader:
        assert reader.message_count == saved.messages
        assert len(list(reader.messages())) == saved.messages


def test_a_file_cut_anywhere_gives_its_whole_chunks_or_one_line(tmp_path: Path) -> None:
    path = tmp_path / "whole.mcap"
    with BagWriter(path, background=False) as writer:
        for i in range(60):
            writer.write(i / 10, {"throttle": 0.5, "tractor_vx_mps": 20.0 + i})
            if i % 10 == 9:
                writer.flush()
    whole = path.read_bytes()
    cut = tmp_path / "cut.mcap"
    lengths = set()
    for size in range(0, len(whole), 37):
        cut.write_bytes(whole[:size])
        try:
            recording = read_recording(cut)
        except InputError:
            with pytest.raises(InputError):
                recover(cut)
            continue
        lengths.add(len(recording["tractor_vx_mps"]))
        recovered = recover(cut, tmp_path / "recovered.mcap")
        again = read_recording(recovered.path)
        assert dict(again.channels) == dict(recording.channels)
        assert again.notes == ()
    assert lengths == {10, 20, 30, 40, 50, 60}


def test_recovering_a_whole_file_changes_no_message(tmp_path: Path) -> None:
    path = tmp_path / "whole.mcap"
    with BagWriter(path, background=False, metadata={"test": "x"}) as writer:
        for i in range(100):
            writer.write(i / 10, {"throttle": 0.5, "tractor_vx_mps": 20.0 + i})
    before = read_recording(path)
    assert recover(path).lost_bytes == 0
    after = read_recording(path)
    assert dict(after.channels) == dict(before.channels)
    assert dict(after.metadata) == dict(before.metadata)


def test_a_full_disk_is_one_clear_error_and_spoils_nothing(tmp_path: Path) -> None:
    path = tmp_path / "full.mcap"
    said = run_on_full_disk(path, "raise")
    assert said.startswith("refused:")
    assert "File too large" in said
    assert str(path) in said
    assert "messages saved" in said
    recording = read_recording(path)
    assert len(recording["throttle"]) > 1000
    found = scan(path)
    assert found.finished or found.good_end == found.size, "half a chunk was left behind"
    with path.open("rb") as file:
        assert sum(type(r).__name__ == "Message" for r in stream_until_it_ends(file)) > 2000


def test_a_full_disk_can_be_left_to_the_state(tmp_path: Path) -> None:
    said = run_on_full_disk(tmp_path / "full.mcap", "report")
    assert "error=''" not in said
    assert "dropped=0" not in said
    assert len(read_recording(tmp_path / "full.mcap")["throttle"]) > 1000


def test_a_disk_that_is_gone_ends_the_bag_and_not_its_writer(tmp_path: Path) -> None:
    """Pulled out: no write, and no cutting back either."""
    path = tmp_path / "gone.mcap"
    writer = BagWriter(path, background=False, raise_errors=False)
    writer.write(0.0, {"throttle": 0.25})
    writer.flush()
    pull_out(writer)
    writer.write(1.0, {"throttle": 0.5})
    writer.flush()
    assert "cannot write: No space left on device; 1 messages saved" in writer.state.error
    assert writer.state.dropped == 1
    writer.close()
    assert read_recording(path)["throttle"].value.tolist() == [0.25]


def test_the_thread_that_writes_says_when_the_disk_is_gone(tmp_path: Path) -> None:
    writer = BagWriter(tmp_path / "gone.mcap", flush_s=0.1, raise_errors=False)
    pull_out(writer)
    writer.write(0.0, {"throttle": 0.5})
    deadline = time.monotonic() + 60.0
    while not writer.state.error:
        assert time.monotonic() < deadline, "the thread ended without a word"
        time.sleep(0.02)
    writer.close()
    assert "cannot write: No space left on device; 0 messages saved" in writer.state.error
    assert writer.state.dropped == 1


def pull_out(writer: BagWriter) -> None:
    """Put a device there that takes no byte and cannot be cut."""
    gone = os.open("/dev/full", os.O_WRONLY)
    os.dup2(gone, writer._file._file.fileno())
    os.close(gone)


def run_on_full_disk(path: Path, mode: str) -> str:
    done = subprocess.run([sys.executable, "-c", FULL_DISK, str(path), mode],
                          capture_output=True, text=True, check=False)  # fmt: skip
    assert done.returncode == 0, done.stderr
    return done.stdout.strip()


def stream_until_it_ends(file: object) -> list[object]:
    records = []
    try:
        for record in StreamReader(file).records:  # type: ignore[arg-type]
            records.append(record)
    except McapError:
        return records
    return records


def test_samples_reach_the_disk_while_nothing_more_is_written(tmp_path: Path) -> None:
    """A paused simulation must not keep its last samples in memory."""
    path = tmp_path / "paused.mcap"
    writer = BagWriter(path, flush_s=0.2)
    writer.write(1.0, {"throttle": 0.5})
    deadline = time.monotonic() + 60.0
    while time.monotonic() < deadline and writer.state.bytes_on_disk < 500:
        time.sleep(0.02)
    assert read_recording(path)["throttle"].value.tolist() == [0.5]
    writer.close()
    writer.close()


def test_a_folder_that_is_there_is_not_written_into(tmp_path: Path) -> None:
    (tmp_path / "bag").mkdir()
    (tmp_path / "bag" / "mine.txt").write_text("x")
    with pytest.raises(InputError, match="exists already"):
        BagWriter(tmp_path / "bag")


def test_a_file_that_is_there_is_not_written_over(tmp_path: Path) -> None:
    (tmp_path / "mine.mcap").write_bytes(b"mine")
    with pytest.raises(InputError, match="exists already"):
        BagWriter(tmp_path / "mine.mcap")
    assert (tmp_path / "mine.mcap").read_bytes() == b"mine"


def test_no_permission_is_a_storage_error(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("x")
    with pytest.raises(StorageError, match="cannot"):
        BagWriter(tmp_path / "file" / "bag.mcap")


def test_what_cannot_be_written_is_refused_where_it_happens(tmp_path: Path) -> None:
    with BagWriter(tmp_path / "bag", background=False) as writer:
        stream = writer.stream(["throttle", "tractor_vx_mps"])
        stream.write(1.0, [0.5, 20.0])
        with pytest.raises(ValueError, match="tractor_vx_mps is not finite"):
            stream.write(2.0, [0.5, np.nan])
        with pytest.raises(ValueError, match="backwards"):
            stream.write(0.5, [0.5, 20.0])
        with pytest.raises(ValueError, match="before the bag's origin"):
            stream.write(-1.0, [0.5, 20.0])
        with pytest.raises(KeyError, match="speed_of_light"):
            writer.stream(["speed_of_light"])
        with pytest.raises(ValueError, match="not of type"):
            writer.message("throttle", "std_msgs/msg/String", 1.0, b"")
    assert len(read_recording(tmp_path / "bag")["throttle"]) == 1


def test_five_seconds_of_all_topics_at_100_hz_are_all_written(tmp_path: Path) -> None:
    names = [c.name for c in channels_for() if c.place]
    values = np.linspace(0.1, 0.9, len(names))
    with BagWriter(tmp_path / "bag") as writer:
        stream = writer.stream(names)
        for i in range(500):
            stream.write(0.01 * i, values)
        writer.flush()
        assert writer.state.messages == 500 * len(stream.topics)


def test_a_bag_that_goes_with_its_error_claims_no_messages(tmp_path: Path) -> None:
    with pytest.raises(StorageError) as caught, replacing(tmp_path / "bag") as temporary:
        raise storage_error(temporary, OSError(errno.ENOSPC, "No space left"), "9 messages saved")
    assert str(caught.value) == f"{tmp_path / 'bag'}: cannot write: No space left"
    kept = storage_error(tmp_path / "bag", OSError(errno.ENOSPC, "No space left"), "9 messages")
    assert str(pickle.loads(pickle.dumps(kept))).endswith("cannot write: No space left; 9 messages")
