"""Bags with damage inside, as a power cut leaves them: all that is whole is recovered."""

from __future__ import annotations

import struct
from itertools import pairwise
from pathlib import Path

import pytest
from mcap.reader import make_reader

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings import BagWriter, read_recording
from truck_blowout_sim.recordings.recover import recover

CHUNK = 6
ROWS_A_CHUNK, CHUNKS = 10, 4


@pytest.fixture
def bag(tmp_path: Path) -> Path:
    """A closed folder of four chunks; throttle begins in the second."""
    with BagWriter(tmp_path / "bag", background=False) as writer:
        for i in range(ROWS_A_CHUNK * CHUNKS):
            values = {"tractor_vx_mps": 20.0 + i}
            writer.write(i / 10, values if i < ROWS_A_CHUNK else {**values, "throttle": 0.5})
            if i % ROWS_A_CHUNK == ROWS_A_CHUNK - 1:
                writer.flush()
    return tmp_path / "bag"


def chunks(data: bytes) -> list[tuple[int, int]]:
    at, found = 8, []
    while at + 9 <= len(data):
        opcode, length = struct.unpack_from("<BQ", data, at)
        if opcode == CHUNK:
            found.append((at, at + 9 + length))
        at += 9 + length
    return found


def damage(bag: Path, number: int, *, closed: bool = True) -> int:
    """Overwrite the end of a chunk by zeros; gives the chunk's size."""
    path = bag / "bag_0.mcap"
    data = bytearray(path.read_bytes())
    places = chunks(bytes(data))
    start, end = places[number]
    data[end - 20 : end] = bytes(20)
    path.write_bytes(data if closed else data[: places[-1][1]])
    return end - start


def speeds(bag: Path) -> list[float]:
    return list(read_recording(bag)["tractor_vx_mps"].value)


@pytest.mark.parametrize("number", range(CHUNKS))
def test_all_chunks_but_the_damaged_one_are_kept(bag: Path, number: int) -> None:
    size = damage(bag, number)
    saved = recover(bag)
    assert (saved.lost, saved.lost_bytes) == ({"chunk": 1}, size)
    rows = range(ROWS_A_CHUNK * CHUNKS)
    assert speeds(bag) == [20.0 + i for i in rows if i // ROWS_A_CHUNK != number]
    assert read_recording(bag).notes == ()
    with (bag / "bag_0.mcap").open("rb") as file:
        read = list(make_reader(file, validate_crcs=True).iter_messages())
    assert len(read) == saved.messages


def test_messages_that_nothing_describes_are_left_out_and_counted(bag: Path) -> None:
    """The chunk that describes the throttle is lost, and the file has no summary."""
    damage(bag, 1, closed=False)
    saved = recover(bag)
    assert saved.lost == {"chunk": 1, "message": 2 * ROWS_A_CHUNK}
    assert len(speeds(bag)) == 3 * ROWS_A_CHUNK
    assert "throttle" not in read_recording(bag)


def test_a_tail_of_zeros_is_cut_off(bag: Path) -> None:
    path = bag / "bag_0.mcap"
    data = path.read_bytes()
    end = chunks(data)[1][1]
    path.write_bytes(data[:end] + bytes(4096))
    with pytest.raises(InputError, match=r"byte \d+: opcode 0.*truck-blowout recover BAG"):
        read_recording(path)
    saved = recover(bag)
    assert (saved.lost, saved.lost_bytes) == ({}, 4096)
    assert len(speeds(bag)) == 2 * ROWS_A_CHUNK


def test_a_wrong_length_loses_what_follows(bag: Path) -> None:
    path = bag / "bag_0.mcap"
    data = bytearray(path.read_bytes())
    at = chunks(bytes(data))[2][0]
    data[at + 8] = 0x7F
    path.write_bytes(data)
    saved = recover(bag)
    assert (saved.lost, saved.lost_bytes) == ({"chunk": 1}, len(data) - at)
    assert len(speeds(bag)) == 2 * ROWS_A_CHUNK


def test_readers_refuse_and_tell_what_to_do(bag: Path) -> None:
    damage(bag, 2)
    with pytest.raises(InputError) as caught:
        read_recording(bag)
    line = str(caught.value)
    assert "damaged chunk record" in line
    assert "truck-blowout recover BAG" in line


def test_where_nothing_is_whole_the_old_file_stays(bag: Path) -> None:
    for number in range(CHUNKS):
        damage(bag, number)
    before = {path.name: path.read_bytes() for path in bag.iterdir()}
    with pytest.raises(InputError, match="no whole chunk"):
        recover(bag)
    assert {path.name: path.read_bytes() for path in bag.iterdir()} == before


def test_recovered_stamps_do_not_run_backwards(bag: Path) -> None:
    damage(bag, 1)
    recover(bag)
    times = read_recording(bag)["tractor_vx_mps"].time_s
    assert all(one < other for one, other in pairwise(times))
