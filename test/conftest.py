"""What every test may ask for."""

from __future__ import annotations

import os
import signal
import threading
from importlib.util import find_spec
from pathlib import Path

import pytest

if find_spec("hypothesis"):
    from hypothesis import HealthCheck, settings

    # The same examples every time, and no verdict on how busy the machine is.
    settings.register_profile(
        "repeatable", deadline=None, derandomize=True, suppress_health_check=[HealthCheck.too_slow]
    )
    settings.load_profile("repeatable")

# A shell that starts the tests in the background makes them, and all they start, deaf to Ctrl-C.
if (threading.current_thread() is threading.main_thread()
        and signal.getsignal(signal.SIGINT) is signal.SIG_IGN):
    signal.signal(signal.SIGINT, signal.default_int_handler)

ROOT = Path(__file__).resolve().parents[1]


@pytest.fixture(scope="session")
def shared_recordings() -> Path:
    """Folder with sample recordings that are not part of the product.

    The environment variable TRUCK_BLOWOUT_RECORDINGS names it; else it is looked for beside the
    repository. A test that needs it is skipped, visibly, where it is missing.
    """
    named = os.environ.get("TRUCK_BLOWOUT_RECORDINGS")
    folder = Path(named) if named else ROOT.parent / "shared" / "recordings"
    if not folder.is_dir():
        pytest.skip("sample recordings not available")
    return folder
