"""A bag of a log shows the truck: frames where they were measured, and never a place made up."""

from __future__ import annotations

import math
from collections import defaultdict
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from mcap.reader import make_reader

from truck_blowout_sim import Recording, Series, load_vehicle, simulate, write_recording
from truck_blowout_sim.motion import shown
from truck_blowout_sim.recordings.message_types import typestore

VEHICLE = load_vehicle("international_9400i_trailmobile")
TIME = np.arange(0.0, 2.001, 0.01)


def recording(**channels: float | np.ndarray) -> Recording:
    return Recording("log", {name: Series(TIME, np.broadcast_to(value, TIME.shape))
                             for name, value in channels.items()})  # fmt: skip


def written(run: Recording, folder: Path) -> tuple[dict[str, list[Any]], tuple[str, ...]]:
    """Messages by topic of the bag, and what was assumed."""
    scene = shown(run, VEHICLE)
    write_recording(run, folder / "log.mcap", beside=scene.messages)
    found = defaultdict(list)
    with (folder / "log.mcap").open("rb") as stream:
        for schema, channel, message in make_reader(stream).iter_messages():
            assert schema is not None
            decoded = typestore().deserialize_cdr(message.data, schema.name)
            found[channel.topic].append((message.log_time, decoded))
    return found, scene.assumptions


def frames(message: Any) -> dict[str, Any]:  # noqa: ANN401  # a message of rosbags
    return {one.child_frame_id: one for one in message.transforms}


def test_a_log_with_positions_places_the_truck_in_map(tmp_path: Path) -> None:
    log = recording(tractor_x_m=10.0 * TIME, tractor_y_m=3.0, tractor_yaw_rad=0.2,
                    tractor_vx_mps=10.0, steering_wheel_angle_rad=0.5)
    found, assumed = written(log, tmp_path)
    last_ns, last = found["/tf"][-1]
    assert last_ns == 2_000_000_000
    place = frames(last)["tractor/base_link"]
    assert place.header.frame_id == "map"
    assert (place.transform.translation.x, place.transform.translation.y) == (
        pytest.approx(20.0), pytest.approx(3.0))  # fmt: skip
    assert place.transform.rotation.z == pytest.approx(math.sin(0.1))
    steer = frames(last)["steer_left/knuckle"].transform.rotation.z
    ratio = VEHICLE.spec.steering.ratio if VEHICLE.spec.steering else math.nan
    assert steer == pytest.approx(math.sin(0.25 / ratio))
    assert len(found["/truck/robot_description"]) == len(found["/tf_static"]) == 1
    assert len(found["/clock"]) == len(found["/tf"]) == 101
    assert not any(words.startswith("place of the") for words in assumed)


def test_a_log_without_positions_says_so_and_places_nothing_in_map(tmp_path: Path) -> None:
    found, assumed = written(recording(tractor_vx_mps=10.0), tmp_path)
    parents = {one.header.frame_id for _, message in found["/tf"] for one in message.transforms}
    assert "map" not in parents
    assert "tractor/base_link" in parents
    assert "no transform from map" in assumed[0]
    assert not any("integrated" in words for words in assumed)
    assert "/truck/tire_forces" not in found


def test_a_run_read_from_a_bag_shows_what_the_run_showed(tmp_path: Path) -> None:
    run = simulate(VEHICLE, "steer_axle_blowout").between(4.0, 6.5)
    found, assumed = written(run, tmp_path)
    assert not any("not recorded" in words and "height" not in words for words in assumed), assumed
    _, last = found["/tf"][-1]
    for unit in VEHICLE.units:
        place = frames(last)[f"{unit}/base_link"].transform.translation
        assert place.x == pytest.approx(run[f"{unit}_x_m"].value[-1], abs=0.1)
        assert place.y == pytest.approx(run[f"{unit}_y_m"].value[-1], abs=0.1)
    arrows = found["/truck/tire_forces"]
    up = sum(one.points[1].z - one.points[0].z for one in arrows[0][1].markers)
    weight_m = sum(run[f"tire_fz_{tire}_n"].value[0] for tire in VEHICLE.tires) / 20000.0
    assert up == pytest.approx(weight_m)
    red = {one.text for one in arrows[-1][1].markers if one.color.r > one.color.g}
    assert red == {tire for event in run.blowouts for tire in event.tires}
