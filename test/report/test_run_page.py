"""The page a run ends with: the truck where it was, five instants, every group of channels."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from truck_blowout_sim import Blowout, Recording, Series, Vehicle, load_vehicle
from truck_blowout_sim.motion import motion_of
from truck_blowout_sim.report.run_page import five_instants, run_pictures, write_run_page
from truck_blowout_sim.report.style import VERMILION, new_axes
from truck_blowout_sim.report.truck_above import draw_above

TIME = np.arange(0.0, 10.01, 0.1)


def drive(burst_s: float | None = 4.0) -> Recording:
    channels = {"tractor_vx_mps": 20.0 + 0.0 * TIME, "tractor_yaw_rate_radps": 0.02 * (TIME > 4),
                "tractor_roll_rad": 0.01 * np.sin(TIME), "tire_fx_steer_left_n": -4000.0 + 0 * TIME,
                "tire_fy_steer_left_n": 0.0 * TIME, "tire_fz_steer_left_n": 26_000 + 0 * TIME}
    events = () if burst_s is None else (Blowout(burst_s, ("steer_left",)),)
    return Recording("run", {n: Series(TIME, v) for n, v in channels.items()}, events)


def test_five_instants_begin_with_the_blowout_and_end_with_the_run(vehicle: Vehicle) -> None:
    motion = motion_of(drive(), vehicle)
    times = motion.times_s[five_instants(drive(), motion)]
    assert times == pytest.approx([4.0, 4.5, 5.0, 6.0, 10.0])
    late = drive(9.5)
    assert np.all(np.diff(five_instants(late, motion_of(late, vehicle))) > 0)
    none = drive(None)
    assert motion.times_s[five_instants(none, motion)] == pytest.approx([0, 2.5, 5, 7.5, 10])


def test_the_flat_tire_alone_is_colored_and_stands_where_it_is(vehicle: Vehicle) -> None:
    from matplotlib.colors import to_hex

    motion = motion_of(drive(), vehicle)
    index = int(np.argmin(np.abs(motion.times_s - 5.0)))
    _, axes = new_axes()
    draw_above(axes, vehicle, motion, index)
    flat = [p for p in axes.patches if to_hex(p.get_facecolor()) == VERMILION]
    assert len(flat) == 1
    middle = flat[0].get_xy()[:4].mean(axis=0)
    track = motion.units["tractor"]
    yaw = float(track.yaw_rad[index])
    expected = (track.x_m[index] + 2.42 * np.cos(yaw) - 1.025 * np.sin(yaw),
                track.y_m[index] + 2.42 * np.sin(yaw) + 1.025 * np.cos(yaw))
    assert middle == pytest.approx(expected, abs=1e-6)


def test_a_folded_truck_is_drawn_whole(vehicle: Vehicle) -> None:
    run = drive()
    channels = {**run.channels, "articulation_rad": Series(TIME, -0.25 * (TIME - 4).clip(0))}
    folded = Recording("run", channels, run.blowouts)
    picture = run_pictures(folded, motion_of(folded, vehicle), vehicle)[0]
    picture.figure.draw_without_rendering()
    for axes in picture.figure.axes:
        low, high = axes.get_ylim()
        drawn = np.concatenate([p.get_path().vertices[:, 1] for p in axes.patches])
        assert low < drawn.min()
        assert drawn.max() < high
    assert np.ptp(picture.figure.axes[-1].get_ylim()) > np.ptp(picture.figure.axes[0].get_ylim())


@pytest.mark.parametrize("name", ["international_9400i_trailmobile", "rigid_truck"])
def test_every_vehicle_has_its_pictures(name: str) -> None:
    vehicle = load_vehicle(name)
    pictures = run_pictures(drive(), motion_of(drive(), vehicle), vehicle)
    names = [picture.name for picture in pictures]
    assert names[:2] == ["truck_above", "path"]
    assert "tires" in names


def test_no_label_is_cut_off(vehicle: Vehicle) -> None:
    run = drive()
    for picture in run_pictures(run, motion_of(run, vehicle), vehicle):
        picture.figure.draw_without_rendering()
        paper = picture.figure.bbox
        for axes in picture.figure.axes:
            label = axes.yaxis.label.get_window_extent()
            assert paper.y0 <= label.y0, (picture.name, label)
            assert label.y1 <= paper.y1, (picture.name, label)


@pytest.mark.parametrize(("units", "length", "force"), [("us", "ft", "lbf"), ("si", "m", "kN")])
def test_lengths_and_arrows_have_the_units_of_the_curves(vehicle: Vehicle, units: str, length: str,
                                                         force: str) -> None:
    run = drive()
    above, path = run_pictures(run, motion_of(run, vehicle), vehicle, units)[:2]
    assert above.figure.axes[-1].get_xlabel() == length
    assert f"1 {length} = " in above.caption
    assert f" {force}." in above.caption
    assert path.figure.axes[-1].get_xlabel().endswith(f"({length})")
    path.figure.draw_without_rendering()
    axes = path.figure.axes[-1]
    words = [text.get_text().replace("\N{MINUS SIGN}", "-") for text in axes.get_xticklabels()]
    per_m = {"ft": 1 / 0.3048, "m": 1.0}[length]
    expected = per_m * np.array(axes.get_xticks())
    assert [float(word) for word in words] == pytest.approx(expected, rel=1e-5)


def test_the_page_says_the_result_and_needs_no_other_file(tmp_path: Path, vehicle: Vehicle) -> None:
    run = drive()
    page = write_run_page(run, motion_of(run, vehicle), vehicle, "it stayed <in> its lane",
                          tmp_path / "run.html").read_text()
    assert "it stayed &lt;in&gt; its lane" in page
    assert 'src="data:image/svg+xml' in page
