"""Where a bag goes: new folders and files, and what may be replaced."""

from __future__ import annotations

from pathlib import Path

from truck_blowout_sim.errors import InputError, StorageError
from truck_blowout_sim.recordings.bag_metadata import FILE_NAME


def check_target(path: Path) -> None:
    """Refuse to replace what is not a bag.

    Raises:
        InputError: for a path that is something else already.
    """
    bare = path.suffix == ".mcap"
    if not path.exists() or (bare and path.is_file()):
        return
    names = {entry.name for entry in path.iterdir()} if path.is_dir() else {path.name}
    foreign = sorted(n for n in names if n != FILE_NAME and not n.endswith(".mcap"))
    if foreign or bare:
        raise InputError(
            f"exists already and holds {foreign[0] if foreign else 'a folder'}",
            file=path,
            expected="a new name, or a bag to replace",
        )


def create_target(path: Path, stem: str) -> Path:
    """Create the folder of a new bag and name its data file.

    Args:
        path: of a rosbag2 folder, or of a bare file if it ends in ``.mcap``.
        stem: begins the file's name in a folder.

    Raises:
        InputError: the file is there already, or the folder and it is not empty.
        StorageError: it cannot be created.
    """
    if path.suffix == ".mcap" and not path.exists():
        _make_folder(path.parent)
        return path
    if path.is_dir() and not any(path.iterdir()):
        return path / f"{stem}_0.mcap"
    if path.exists():
        raise InputError(
            "exists already",
            file=path,
            expected=f"a new .mcap file, or a new folder for {FILE_NAME}",
        )
    _make_folder(path)
    return path / f"{stem}_0.mcap"


def _make_folder(folder: Path) -> None:
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        words = f"cannot create the folder: {error.strerror}"
        raise StorageError(words, file=folder, number=error.errno or 5) from error
