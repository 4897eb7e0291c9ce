"""A film of the page: a browser draws each picture, ffmpeg joins them.

Validated with: test/report/test_viewer_in_browser.py.
"""

from __future__ import annotations

import base64
import shutil
import subprocess
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings.atomic import replacing
from truck_blowout_sim.report.viewer.browser import Browser


@dataclass(frozen=True)
class Film:
    """How a film is taken.

    Attributes:
        view: name of a camera of the page.
        size: width and height, pixels; even numbers.
        rate_hz: pictures a second.
        speed: seconds of the run a second of the film.
        start_s, end_s: part of the run; all of it where None.
        dark: dark colors.
    """

    view: str = "chase"
    size: tuple[int, int] = (1280, 720)
    rate_hz: float = 25.0
    speed: float = 1.0
    start_s: float | None = None
    end_s: float | None = None
    dark: bool = False


def write_film(page: Path, path: Path, film: Film, progress: Callable[[float], None]) -> int:
    """Film a page of `write_viewer`.

    Args:
        page: the HTML file.
        path: film to write, .mp4.
        film: how.
        progress: called with the share that is done.

    Returns:
        Number of pictures.

    Raises:
        InputError: ffmpeg or a browser is not installed.
        StorageError: the film cannot be written.
    """
    program = shutil.which("ffmpeg")
    if program is None:
        raise InputError("--video needs ffmpeg, which is not installed", expected="ffmpeg")
    with Browser(page, film.size, dark=film.dark) as browser, replacing(path) as temporary:
        browser.wait_for("!!window.viewer")
        browser.evaluate("window.viewer.then(() => true)")
        start, end = browser.evaluate("[app.start, app.end]")
        start = start if film.start_s is None else max(film.start_s, start)
        end = end if film.end_s is None else min(film.end_s, end)
        if end <= start:
            raise InputError(f"the film would go from {start:g} to {end:g} s",
                             expected="an end after the start")
        browser.evaluate(f"app.seek({start}) || app.view({film.view!r}) || app.film()")
        count = max(round((end - start) / film.speed * film.rate_hz), 1)
        encoder = _encoder(program, film, temporary)
        assert encoder.stdin is not None
        for k in range(count):
            time_s = start + k * film.speed / film.rate_hz
            picture = browser.evaluate(f"app.picture({time_s}, {film.size[0]}, {film.size[1]})")
            try:
                encoder.stdin.write(base64.b64decode(picture.partition(",")[2]))
            except BrokenPipeError:  # ffmpeg has ended; below it says why
                break
            progress((k + 1) / count)
        _, problem = encoder.communicate()
        if encoder.returncode:
            raise InputError("ffmpeg failed: " + " ".join(problem.decode(errors="replace").split()))
    return count


def _encoder(program: str, film: Film, target: Path) -> subprocess.Popen[bytes]:
    words = [program, "-loglevel", "error", "-y", "-f", "image2pipe", "-c:v", "mjpeg",
             "-framerate", f"{film.rate_hz:g}", "-i", "-", "-c:v", "libx264", "-pix_fmt",
             "yuv420p", "-crf", "21", "-movflags", "+faststart", str(target)]  # fmt: skip
    return subprocess.Popen(words, stdin=subprocess.PIPE, stderr=subprocess.PIPE)
