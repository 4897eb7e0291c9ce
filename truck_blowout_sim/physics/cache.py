"""Where compiled code is kept: a folder of this user alone, named after the sources.

Numba's cache looks only at the file of the cached function, so a change in a tire file would not
reach a cached step. The folder is therefore named after a digest of all sources here.

References: Numba manual, "Notes on Caching".
Known limits: what is below NUMBA_CACHE_DIR is trusted, as whoever sets it asks for.
Validated with: test/physics/test_jit.py.
"""

from __future__ import annotations

import hashlib
import os
import stat
import tempfile
from pathlib import Path

import numba


def digest() -> str:
    """Digest of Numba's version, of physics/, and of what simulation/ compiles with it."""
    root = Path(__file__).parent
    found = hashlib.sha256(numba.__version__.encode())
    for path in sorted(root.rglob("*.py")):
        found.update(path.read_bytes())
    for path in sorted((root.parent / "simulation").rglob("*.py")):
        source = path.read_bytes()
        if b"physics.jit" in source:
            found.update(source)
    return found.hexdigest()[:16]


def cache_folder() -> Path:
    """Folder for compiled code: as NUMBA_CACHE_DIR says, else the user's cache, else a private one.

    Compiled code is loaded and run, so a folder in the shared temporary directory is used only if
    it belongs to this user and nobody else may write to it.
    """
    chosen = os.environ.get("NUMBA_CACHE_DIR")
    users = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "truck_blowout_sim"
    folder = (Path(chosen) if chosen else users) / digest()
    try:
        folder.mkdir(parents=True, exist_ok=True)
        if os.access(folder, os.W_OK):
            return folder
    except OSError:
        pass
    folder = private_folder(Path(tempfile.gettempdir())) / digest()
    folder.mkdir(exist_ok=True)
    return folder


def private_folder(base: Path) -> Path:
    """A folder below a shared one that is this user's alone; a new one where the usual is not."""
    folder = base / f"truck_blowout_sim-{os.getuid()}"
    try:
        folder.mkdir(mode=0o700, exist_ok=True)
    except OSError:
        return Path(tempfile.mkdtemp(prefix="truck_blowout_sim-", dir=base))
    status = folder.lstat()
    if stat.S_ISDIR(status.st_mode) and status.st_uid == os.getuid() and not status.st_mode & 0o077:
        return folder
    return Path(tempfile.mkdtemp(prefix="truck_blowout_sim-", dir=base))
