"""Write the truck as an FMU.

References: FMI 3.0; pythonfmu3, which wraps a Python class.
Known limits: the importing tool runs the truck in an embedded Python, in whose environment this
package must be installed (`needsExecutionTool`); Linux and Windows on x86-64.
Validated with: test/fmu/test_fmu.py, with fmpy as importer.
"""

from __future__ import annotations

import tempfile
from os import PathLike
from pathlib import Path

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings.claims import claim
from truck_blowout_sim.vehicle import load_vehicle

NAME = "Truck.fmu"
VEHICLE_FILE = "vehicle.txt"


def build_fmu(vehicle: str | PathLike[str], folder: str | PathLike[str], *, force: bool = False
              ) -> Path:
    """Write ``Truck.fmu``.

    Args:
        vehicle: name of a shipped vehicle, or a path; a path must stay valid where the FMU runs.
        folder: where it goes.
        force: replace an existing one.

    Raises:
        InputError: no such vehicle, the file exists, or pythonfmu3 is not installed.
    """
    try:
        from pythonfmu3 import FmuBuilder
    except ImportError:
        raise InputError("pythonfmu3 is not installed",
                         expected="pip install 'truck_blowout_sim[fmu]'") from None
    loaded = load_vehicle(vehicle)
    target = claim(folder, force=force, writes=[NAME],
                   instead="another folder, or --force") / NAME  # fmt: skip
    path = Path(vehicle)
    words = str(path.resolve()) if path.is_file() else loaded.name
    with tempfile.TemporaryDirectory() as work:
        note = Path(work) / VEHICLE_FILE
        note.write_text(words, encoding="utf-8")
        FmuBuilder.build_FMU(Path(__file__).with_name("truck_slave.py"), dest=folder,
                             project_files=[note])
    return target
