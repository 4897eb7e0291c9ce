"""The named layout of parameters, state, inputs and working memory of one truck.

Every quantity of the compiled core lives in one flat float64 vector. A block is a ``NamedTuple``
whose fields carry the unit; ``UNIT.mass_kg`` is the position of that field inside a unit's block.
Counts (units, axles, hubs, tires) come from the topology vector, so nothing here knows how many
axles a vehicle has. Numba folds the constants.

References: none, this is bookkeeping.
Known limits: at most two units; tires, the last blocks, stand side by side (`tires.lanes`); an
axle has exactly one left and one right hub.
Validated with: test/physics/test_layout.py.
"""

from __future__ import annotations

from typing import Any, NamedTuple, TypeVar

from truck_blowout_sim.physics.layout_params import (
    AbsParams,
    AxleParams,
    CircuitParams,
    CouplingParams,
    DrivelineParams,
    HubParams,
    SteeringParams,
    UnitParams,
    WorldParams,
)
from truck_blowout_sim.physics.layout_state import (
    AxleState,
    GlobalState,
    HubState,
    TireState,
    Topology,
    UnitState,
)
from truck_blowout_sim.physics.layout_tire import TireParams

__all__ = [
    "ABS",
    "ABS_AT",
    "AXLE",
    "AXLE_S",
    "AXLE_SIZE",
    "CIRCUIT",
    "CIRCUIT_AT",
    "CIRCUIT_SIZE",
    "COUPLING",
    "COUPLING_AT",
    "DRIVE",
    "DRIVE_AT",
    "GLOBAL_S",
    "HUB",
    "HUB_S",
    "HUB_SIZE",
    "INPUT",
    "MAX_BLOCKS",
    "MAX_TIRES",
    "N_CIRCUITS",
    "N_INPUTS",
    "N_STEP_COLUMNS",
    "N_WORK",
    "SLIPS_AT",
    "STATE_UNIT_AT",
    "STEER",
    "STEER_AT",
    "STEP_COLUMNS",
    "TIRE",
    "TIRE_BLOCK",
    "TIRE_LANES",
    "TIRE_S",
    "TOPOLOGY",
    "TOPOLOGY_AXLE_SIZE",
    "TOPOLOGY_SIZE",
    "UNIT",
    "UNIT_AT",
    "UNIT_S",
    "UNIT_SIZE",
    "UNIT_W",
    "UNIT_WORK_SIZE",
    "WORLD",
    "WORLD_AT",
    "AbsParams",
    "AxleParams",
    "AxleState",
    "CircuitParams",
    "CouplingParams",
    "DrivelineParams",
    "GlobalState",
    "HubParams",
    "HubState",
    "InputVector",
    "SteeringParams",
    "TireParams",
    "TireState",
    "Topology",
    "UnitParams",
    "UnitState",
    "UnitWork",
    "WorldParams",
]

Block = TypeVar("Block", bound=tuple[Any, ...])


def _number(block: type[Block], apart: int = 1) -> Block:
    """Number the fields of ``block`` from 0, ``apart`` from each other, and return the instance."""
    places = range(0, apart * len(block._fields), apart)  # type: ignore[attr-defined]
    return block(*places)


WORLD = _number(WorldParams)
STEER = _number(SteeringParams)
COUPLING = _number(CouplingParams)
DRIVE = _number(DrivelineParams)
ABS = _number(AbsParams)
CIRCUIT = _number(CircuitParams)
UNIT = _number(UnitParams)
AXLE = _number(AxleParams)
HUB = _number(HubParams)
# Parameters of tires stand side by side, so that one instruction works on several tires: field by
# field, in each the tires of a block. Tire k of a block has its field at k + TIRE.field.
TIRE_LANES = 24
TIRE = _number(TireParams, apart=TIRE_LANES)

N_CIRCUITS = 3
WORLD_AT = 0
STEER_AT = WORLD_AT + len(WORLD)
COUPLING_AT = STEER_AT + len(STEER)
DRIVE_AT = COUPLING_AT + len(COUPLING)
ABS_AT = DRIVE_AT + len(DRIVE)
CIRCUIT_AT = ABS_AT + len(ABS)
CIRCUIT_SIZE = len(CIRCUIT)
UNIT_AT = CIRCUIT_AT + N_CIRCUITS * CIRCUIT_SIZE
UNIT_SIZE = len(UNIT)
AXLE_SIZE = len(AXLE)
HUB_SIZE = len(HUB)
TIRE_BLOCK = len(TIRE) * TIRE_LANES
MAX_BLOCKS = 6  # of tires; memory alone limits them
MAX_TIRES = MAX_BLOCKS * TIRE_LANES

TOPOLOGY = _number(Topology)
TOPOLOGY_SIZE = len(TOPOLOGY)
# behind the head: per axle (unit, circuit, equaliser partner or -1), then per tire its hub
TOPOLOGY_AXLE_SIZE = 3

GLOBAL_S = _number(GlobalState)
UNIT_S = _number(UnitState)
AXLE_S = _number(AxleState)
HUB_S = _number(HubState)
TIRE_S = _number(TireState)
STATE_UNIT_AT = len(GLOBAL_S)


class InputVector(NamedTuple):
    """What drives the truck; held between step edges."""

    steering_wheel_angle_rad: int
    throttle: int
    brake_pressure_steer_pa: int
    brake_pressure_drive_pa: int
    brake_pressure_trailer_pa: int


INPUT = _number(InputVector)
N_INPUTS = len(INPUT)


class UnitWork(NamedTuple):
    """Working memory of one unit inside a step: rotation, wrench at the centre of gravity."""

    rxx: int  # rotation body -> map, rows map axes
    rxy: int
    rxz: int
    ryx: int
    ryy: int
    ryz: int
    rzx: int
    rzy: int
    rzz: int
    cos_yaw: int
    sin_yaw: int
    fx_n: int  # body axes
    fy_n: int
    fz_n: int
    mx_nm: int
    my_nm: int
    mz_nm: int
    front_nm: int  # roll moment on the frame's front and rear end, and its stiffness
    rear_nm: int
    front_nmprad: int
    rear_nmprad: int
    matrix: int  # first of 21 entries of the upper triangle of the 6x6 mass matrix


UNIT_W = _number(UnitWork)
UNIT_WORK_SIZE = len(UNIT_W) + 21 - 1
SLIPS_AT = 2 * UNIT_WORK_SIZE  # behind both units: brake slips of the hubs, each with a tire
N_WORK = SLIPS_AT + MAX_TIRES

# step table of a blown tire (thesis tables 9 and 10): columns of one row
STEP_COLUMNS = ("time_s", "radius_m", "stiffness_npm", "cornering_scale", "aligning_scale",
                "rolling_0", "rolling_spm")
N_STEP_COLUMNS = len(STEP_COLUMNS)
# a step table begins with its row count; a map begins with (n_slip, n_load, slip step, load step)
