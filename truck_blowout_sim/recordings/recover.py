"""Make a bag whole again whose writer was killed: every whole chunk kept, index and summary new.

References: MCAP specification; rosbag2 ``metadata.yaml``.
Known limits: see `salvage`; a chunk that breaks off in the middle is lost (at most the last half
second here).
Validated with: test/recordings/test_recover_damaged.py, test_bad_bags.py, with mcap and rosbags
reading the result.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings.atomic import replacing
from truck_blowout_sim.recordings.bag_metadata import describe, write_metadata
from truck_blowout_sim.recordings.mcap_file import McapFile
from truck_blowout_sim.recordings.mcap_scan import MappedFile
from truck_blowout_sim.recordings.salvage import Salvage


@dataclass(frozen=True)
class Recovered:
    """What was saved.

    Attributes:
        path: file or folder that is readable again.
        messages: in it.
        lost_bytes: of damaged records and the broken tail.
        lost: records left out, by kind: ``chunk``, ``message`` …
    """

    path: Path
    messages: int
    lost_bytes: int
    lost: Mapping[str, int] = field(default_factory=dict)


def recover(path: Path, output: Path | None = None) -> Recovered:
    """Recover a bare file or a rosbag2 folder, in place unless an output is given.

    A file that is whole is rewritten with the same messages. Damaged chunks are left out. The old
    file is replaced only when the new one is complete.

    Args:
        path: ``.mcap`` file, or folder with such files.
        output: file to write instead; for a folder, the folder.

    Raises:
        InputError: not MCAP, or nothing whole in it.
        StorageError: the new file cannot be written.
    """
    if not path.is_dir():
        return _recover_file(path, output or path)[0]
    files = sorted(path.glob("*.mcap"))
    if len(files) != 1:
        raise InputError(f"holds {len(files)} .mcap files", file=path, expected="a bag of one file")
    folder = output or path
    folder.mkdir(parents=True, exist_ok=True)
    saved, file, custom = _recover_file(files[0], folder / files[0].name)
    write_metadata(folder, describe(file.contents, file.path.name, custom))
    return Recovered(folder, saved.messages, saved.lost_bytes, saved.lost)


def _recover_file(path: Path, output: Path) -> tuple[Recovered, McapFile, dict[str, str]]:
    with MappedFile(path) as data, replacing(output) as temporary:
        file = McapFile(temporary)
        salvage = Salvage(file, data)
        salvage.take_all()
        if not file.contents.message_count:
            file.abandon()
            raise InputError(
                "no whole chunk in it", file=path, expected="a bag with messages to recover"
            )
        file.close()
        file.path = output
    messages = file.contents.message_count
    return Recovered(output, messages, salvage.lost_bytes, dict(salvage.lost)), file, salvage.custom
