"""An encoder or browser that ends too early is named; the film of before stays."""

from __future__ import annotations

import base64
from pathlib import Path
from types import TracebackType
from typing import Any

import pytest

from truck_blowout_sim.cli.failures import REFUSED, report
from truck_blowout_sim.errors import InputError
from truck_blowout_sim.report.viewer import browser as browsing
from truck_blowout_sim.report.viewer import film as filming
from truck_blowout_sim.report.viewer.browser import Browser
from truck_blowout_sim.report.viewer.film import Film, write_film


class Pictures:
    """Stands for a browser: a run of one second, in pictures of 100 kB."""

    def __init__(self, *_: object, **__: object) -> None:
        self.picture = "data:image/jpeg;base64," + base64.b64encode(bytes(100_000)).decode()

    def wait_for(self, expression: str) -> None:
        """It is there at once."""

    def evaluate(self, expression: str) -> Any:  # noqa: ANN401
        return [0.0, 1.0] if expression == "[app.start, app.end]" else self.picture

    def __enter__(self) -> Pictures:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None,
                 trace: TracebackType | None) -> None:
        """Nothing to close."""


def program(folder: Path, name: str, text: str) -> str:
    path = folder / name
    path.write_text(f"#!/bin/bash\n{text}\n")
    path.chmod(0o755)
    return str(path)


def status_of(error: BaseException, capsys: pytest.CaptureFixture[str]) -> tuple[int, str]:
    status = report(error, program="truck-blowout", traceback=False)
    return status, capsys.readouterr().err


def test_what_ffmpeg_says_is_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    ffmpeg = program(tmp_path, "ffmpeg", "echo \"Unknown encoder 'libx264'\" >&2; exit 1")
    monkeypatch.setattr(filming, "Browser", Pictures)
    monkeypatch.setattr(filming.shutil, "which", lambda name: ffmpeg)
    (tmp_path / "film.mp4").write_text("kept")
    with pytest.raises(InputError) as caught:
        write_film(tmp_path / "page.html", tmp_path / "film.mp4", Film(), lambda share: None)
    status, said = status_of(caught.value, capsys)
    assert status == REFUSED
    assert said == "truck-blowout: ffmpeg failed: Unknown encoder 'libx264'\n"
    assert (tmp_path / "film.mp4").read_text() == "kept"


def test_a_browser_that_ends_at_once_is_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    ends = program(tmp_path, "chromium", "exit 1")
    monkeypatch.setattr(browsing, "find_browser", lambda: ends)
    with pytest.raises(InputError) as caught:
        Browser(tmp_path / "page.html", timeout_s=20.0)
    status, said = status_of(caught.value, capsys)
    assert status == REFUSED
    assert "the browser ended at Target.createTarget" in said
