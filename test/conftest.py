"""What every test may ask for."""

from __future__ import annotations

import os

# Before the first import of numpy, also in what tests start: several processes share the cores, and
# BLAS threads that wait for each other made two files of tests take 255 s instead of 98 s.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

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

# Files that take long come first, so that at the end no process works on one while the others have
# nothing left. The second compiles the model; the first and the fourth take until then without it.
LONG_FILES = (
    "test_style.py", "proof/test_ci_sound_trucks.py", "proof/test_ci_effects.py",
    "test_packaging.py", "test_code_blocks.py", "diagnosis/test_sample_recordings.py",
    "simulation/test_abreast.py",
)  # fmt: skip


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Long files first, all others in the order in which they were found."""
    place = {ROOT / "test" / name: k for k, name in enumerate(LONG_FILES)}
    missing = [str(path) for path in place if not path.is_file()]
    if missing:
        raise pytest.UsageError(f"LONG_FILES names what is not there: {missing}")
    items.sort(key=lambda item: place.get(item.path, len(place)))


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
