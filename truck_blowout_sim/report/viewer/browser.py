"""A browser without a window, driven over a pipe: opens a page, evaluates in it, takes pictures.

References: Chrome DevTools Protocol, `--remote-debugging-pipe` (messages end in a zero byte).
Known limits: Chromium and its kin; POSIX, as the pipe stands on file descriptors 3 and 4.
Validated with: test/report/test_viewer_in_browser.py.
"""

from __future__ import annotations

import contextlib
import json
import os
import select
import shutil
import subprocess
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path
from types import TracebackType
from typing import Any

from truck_blowout_sim.errors import InputError

PROGRAMS = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome")
_FLAGS = (
    "--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--hide-scrollbars",
    "--mute-audio",
    # WebGL by the processor: there is no GPU where films and tests are made
    "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist",
    "--no-first-run", "--disable-extensions", "--disable-background-networking",
    "--disable-gpu-compositing", "--remote-debugging-pipe",
)  # fmt: skip
_CHUNK = 1 << 20


def find_browser() -> str | None:
    """Path of an installed browser, or None."""
    return next((found for name in PROGRAMS if (found := shutil.which(name))), None)


class Browser:
    """One page in a headless browser; a context manager.

    Args:
        page: HTML file to open.
        size: of the window, pixels.
        dark: what the page is told about the user's colors.
        timeout_s: longest wait for one answer.

    Raises:
        InputError: no browser is installed, or it does not answer.
    """

    def __init__(self, page: Path, size: tuple[int, int] = (1280, 800), *, dark: bool = False,
                 timeout_s: float = 60.0) -> None:
        program = find_browser()
        if program is None:
            raise InputError("no browser found", expected="one of " + ", ".join(PROGRAMS))
        self._timeout_s, self._next, self._rest = timeout_s, 0, b""
        self.errors: list[str] = []
        self._folder = tempfile.TemporaryDirectory(prefix="truck_view_")
        self._start([program, *_FLAGS, f"--user-data-dir={self._folder.name}",
                     f"--window-size={size[0]},{size[1]}", "about:blank"])
        target = self._call("Target.createTarget", url="about:blank")["targetId"]
        attached = self._call("Target.attachToTarget", targetId=target, flatten=True)
        self._session: str | None = attached["sessionId"]
        self._call("Runtime.enable")
        self._call("Emulation.setDeviceMetricsOverride", width=size[0], height=size[1],
                   deviceScaleFactor=1, mobile=False)
        color = {"name": "prefers-color-scheme", "value": "dark" if dark else "light"}
        self._call("Emulation.setEmulatedMedia", features=[color])
        self._call("Page.navigate", url=page.resolve().as_uri())

    def evaluate(self, expression: str) -> Any:  # noqa: ANN401 -- whatever the page answers
        """Value of a JavaScript expression; promises are awaited.

        Raises:
            InputError: the page throws.
        """
        answer = self._call("Runtime.evaluate", expression=expression, awaitPromise=True,
                            returnByValue=True)
        if "exceptionDetails" in answer:
            raise InputError("the page failed: " + _words(answer["exceptionDetails"]))
        return answer["result"].get("value")

    def wait_for(self, expression: str) -> None:
        """Evaluate until it is true.

        Raises:
            InputError: it stays false.
        """
        end = time.monotonic() + self._timeout_s
        while not self.evaluate(expression):
            if time.monotonic() > end:
                raise InputError(f"the page never came to {expression}; " + "; ".join(self.errors))
            time.sleep(0.05)

    def close(self) -> None:
        """End the browser."""
        with contextlib.suppress(OSError):
            os.close(self._write)
        with contextlib.suppress(OSError):
            os.close(self._read)
        self._process.terminate()
        try:
            self._process.wait(5)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
        with contextlib.suppress(OSError):
            self._folder.cleanup()

    def __enter__(self) -> Browser:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None,
                 trace: TracebackType | None) -> None:
        self.close()

    def _start(self, words: list[str]) -> None:
        """Start with the browser's ends of two pipes on descriptors 3 and 4."""
        theirs_in, self._write = os.pipe()
        self._read, theirs_out = os.pipe()
        # the shell puts the pipes where the browser looks for them
        script = f'exec 3<&{theirs_in} 4>&{theirs_out}; exec "$@"'
        self._session = None
        self._process = subprocess.Popen(
            ["bash", "-c", script, "browser", *words], pass_fds=(theirs_in, theirs_out),
            stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
        )
        os.close(theirs_in)
        os.close(theirs_out)

    def _call(self, method: str, **params: object) -> dict[str, Any]:
        self._next += 1
        message: dict[str, Any] = {"id": self._next, "method": method, "params": params}
        if self._session:
            message["sessionId"] = self._session
        if not self._send(json.dumps(message).encode() + b"\0"):
            raise InputError(f"the browser ended at {method}")
        for answer in self._messages():
            if answer.get("id") == self._next:
                if "error" in answer:
                    raise InputError(f"the browser refused {method}: {answer['error']['message']}")
                return answer.get("result", {})
            if answer.get("method") == "Runtime.exceptionThrown":
                self.errors.append(_words(answer["params"]["exceptionDetails"]))
        raise InputError(f"the browser ended at {method}")

    def _send(self, data: bytes) -> bool:
        """Whether the browser takes it; a broken pipe is the browser's, not that of stdout."""
        try:
            while data:
                data = data[os.write(self._write, data):]
        except BrokenPipeError:
            return False
        return True

    def _messages(self) -> Iterator[dict[str, Any]]:
        end = time.monotonic() + self._timeout_s
        while True:
            while b"\0" in self._rest:
                one, self._rest = self._rest.split(b"\0", 1)
                yield json.loads(one)
            ready, _, _ = select.select([self._read], [], [], max(end - time.monotonic(), 0.0))
            if not ready:
                raise InputError(f"the browser did not answer within {self._timeout_s:g} s")
            chunk = os.read(self._read, _CHUNK)
            if not chunk:
                return
            self._rest += chunk


def _words(details: dict[str, Any]) -> str:
    """An exception of the page on one line."""
    thrown = details.get("exception", {}).get("description", "")
    return " ".join((thrown or details.get("text", "")).split())
