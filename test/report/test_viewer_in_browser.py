"""The page in a real browser: it draws, plays, seeks, and the blown tire is seen."""

from __future__ import annotations

import base64
import io
import shutil
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from matplotlib.image import imread

from truck_blowout_sim import Blowout, Recording, Series, Vehicle
from truck_blowout_sim.motion import motion_of
from truck_blowout_sim.report.viewer import RunToShow, write_viewer
from truck_blowout_sim.report.viewer.browser import Browser, find_browser
from truck_blowout_sim.report.viewer.film import Film, write_film

pytestmark = pytest.mark.skipif(find_browser() is None, reason="no Chromium or Chrome installed")
BURST_S = 1.0


def drive(vehicle: Vehicle, name: str, speed: float) -> RunToShow:
    time = np.arange(0.0, 3.0, 0.02)
    run = Recording(name, {
        "tractor_vx_mps": Series(time, np.full(time.size, speed)),
        "tractor_yaw_rate_radps": Series(time, 0.02 * (time > BURST_S)),
        "tire_fz_steer_left_n": Series(time, np.full(time.size, 2.6e4)),
    }, (Blowout(BURST_S, ("steer_left",)),))  # fmt: skip
    return RunToShow(run, motion_of(run, vehicle), vehicle)


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory, vehicle: Vehicle) -> Path:
    runs = [drive(vehicle, "first", 20.0), drive(vehicle, "second", 19.0)]
    return write_viewer(runs, tmp_path_factory.mktemp("view") / "page.html")


@pytest.fixture(scope="module")
def browser(page: Path) -> Iterator[Browser]:
    with Browser(page, (800, 700)) as opened:
        opened.wait_for("!!window.viewer")
        opened.evaluate("window.viewer.then(() => true)")
        yield opened


def picture(browser: Browser, time_s: float) -> np.ndarray:
    uri = browser.evaluate(f"app.picture({time_s}, 480, 320, 'image/png')")
    return imread(io.BytesIO(base64.b64decode(uri.partition(",")[2])))[..., :3]


def reddish(image: np.ndarray) -> int:
    """Pixels of the color of a blown tire."""
    r, g, b = np.moveaxis(image, 2, 0)
    return int(((r > 0.35) & (r > 1.9 * g) & (r > 2.0 * b)).sum())


def test_the_page_draws_without_an_error(browser: Browser) -> None:
    assert browser.errors == []
    image = picture(browser, 0.5)
    assert image.std() > 0.05


def test_the_blown_tire_is_seen_after_the_blowout_only(browser: Browser) -> None:
    browser.evaluate("app.mode = 'first', app.arrange(), app.view('front left') || true")
    before, after = reddish(picture(browser, 0.5)), reddish(picture(browser, 2.5))
    assert after > before + 100


def test_the_drawn_hub_stands_at_its_height_and_the_truck_at_its_place(browser: Browser) -> None:
    x, height = browser.evaluate(
        "app.seek(2.5) || (() => { const t = app.trucks[0]; return ["
        "t.units.tractor.body.position.x, t.hubs[0].knuckle.position.z]; })()")
    assert x == pytest.approx(50.0, abs=0.1)
    assert height == pytest.approx(0.3485, abs=1e-3)


def test_playing_moves_time_and_the_camera_goes_along(browser: Browser) -> None:
    start = browser.evaluate("app.seek(0) || app.eye.camera.position.x")
    browser.evaluate("app.play(true) || true")
    browser.wait_for("app.t > 0.3")
    browser.evaluate("app.play(false) || true")
    moved = browser.evaluate("app.eye.camera.position.x - app.trucks[0].anchor.x"
                             f" - ({start} - app.trucks[0].anchor.x) - 20 * app.t")
    assert abs(moved) < 1.0


FRAMES_ASKED_FOR = """new Promise(done => {
  const ask = window.requestAnimationFrame; let count = 0;
  window.requestAnimationFrame = f => { count += 1; return ask(f); };
  %s;
  setTimeout(() => { window.requestAnimationFrame = ask; done(count); }, 400);
})"""


def test_a_paused_page_asks_for_no_frames(browser: Browser) -> None:
    browser.evaluate("app.play(false), app.seek(1) || true")
    browser.wait_for("!app.due")
    assert browser.evaluate(FRAMES_ASKED_FOR % "") == 0
    # the camera follows in the first frame, which asks for at most one more
    assert 1 <= browser.evaluate(FRAMES_ASKED_FOR % "app.seek(1.5)") <= 2
    assert browser.evaluate(FRAMES_ASKED_FOR % "app.seek(0), app.play(true)") > 2
    browser.evaluate("app.play(false) || true")


def test_a_paused_page_draws_while_the_camera_moves(browser: Browser) -> None:
    browser.wait_for("!app.due")
    wheel = "document.getElementById('scene').dispatchEvent(new WheelEvent('wheel', {deltaY: 200}))"
    assert browser.evaluate(FRAMES_ASKED_FOR % wheel) >= 1
    browser.wait_for("!app.due")


def test_plots_read_the_channel_at_the_cursor_in_the_chosen_units(browser: Browser) -> None:
    words = browser.evaluate(
        "app.seek(2) || (app.plots.panels.find(p => p.channels[0] === 'tractor_vx_mps')"
        ".chips.textContent)")
    assert "44.74 mph" in words
    assert "42.50 mph" in words


def test_a_rollover_is_drawn_marked_and_said(tmp_path: Path, vehicle: Vehicle) -> None:
    time = np.arange(0.0, 3.0, 0.02)
    run = Recording("over", {
        "tractor_vx_mps": Series(time, np.full(time.size, 20.0)),
        "trailer_roll_rad": Series(time, 0.27 * time),
    }, metadata={"rolled_over_unit": "trailer", "rolled_over_s": "2.984"})  # fmt: skip
    shown = [RunToShow(run, motion_of(run, vehicle), vehicle)]
    with Browser(write_viewer(shown, tmp_path / "over.html"), (800, 700)) as browser:
        browser.wait_for("!!window.viewer")
        browser.evaluate("window.viewer.then(() => true)")
        said = "document.getElementById('readout').textContent"
        assert "rolled over" not in browser.evaluate(f"app.seek(2.5, true) || {said}")
        assert "the trailer rolled over at 2.98 s" in browser.evaluate(
            f"app.key({{key: 'r', target: document.body}}) || {said}")
        assert browser.evaluate("document.querySelectorAll('#marks .over').length") == 1
        assert browser.evaluate("app.trucks[0].units.trailer.body.rotation.x") == pytest.approx(
            0.8, abs=0.02)
        r, g, b = np.moveaxis(picture(browser, 2.5), 2, 0)
        assert ((b > 1.5 * g) & (r > 1.3 * g) & (b > r)).sum() > 20  # the mark on the road


def test_side_by_side_draws_both_halves(browser: Browser) -> None:
    browser.evaluate("app.mode = 'side', app.arrange(), app.view('chase') || true")
    image = picture(browser, 2.0)
    assert image[:, :240].std() > 0.05
    assert image[:, 240:].std() > 0.05
    browser.evaluate("app.mode = 'ghost', app.arrange() || true")


FARTHEST_WORD = """(() => {
  const canvas = CanvasRenderingContext2D.prototype, fillText = canvas.fillText; let reach = 0;
  canvas.fillText = function (words, x, y) {
    reach = Math.max(reach, x + this.measureText(words).width);
    fillText.call(this, words, x, y);
  };
  app.picture(2.0, 240, 300);
  canvas.fillText = fillText;
  return reach;
})()"""


def test_no_word_over_a_picture_is_cut_off(browser: Browser) -> None:
    assert 120.0 < browser.evaluate(FARTHEST_WORD) <= 240.0


@pytest.mark.skipif(shutil.which("ffmpeg") is None, reason="no ffmpeg installed")
def test_a_film_is_written(page: Path, tmp_path: Path) -> None:
    film = tmp_path / "film.mp4"
    assert write_film(page, film, Film(size=(320, 180), rate_hz=10, start_s=0.9, end_s=1.3),
                      lambda share: None) == 4
    assert film.read_bytes()[4:8] == b"ftyp"
