"""What the simulator publishes: the channel table, cut into groups that share a rate."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.display.joints import DisplayJoints
from truck_blowout_sim.recordings.channels import (
    FLUID_PRESSURE,
    IMU,
    JOINT_STATE,
    ODOMETRY,
    Channel,
    Place,
    channels_for,
)
from truck_blowout_sim.recordings.encoder import RowEncoder
from truck_blowout_sim.vehicle import Vehicle

FloatArray = NDArray[np.float64]

GROUPS = ("odometry", "imu", "yaw_rate", "joint_states", "tire_pressure", "brake_chamber")
"""Every output belongs to one; each has a rate of its own."""

# The simulator adds no noise. A variance of 0 means "unknown" to readers of these messages, so
# the covariances state what the numbers are good for: the integration error of a 1 ms step.
VARIANCES = {"m": 1e-6, "rad": 1e-10, "m/s": 1e-8, "rad/s": 1e-10, "m/s2": 1e-4, "Pa": 1.0}


def output_channels(vehicle: Vehicle) -> tuple[Channel, ...]:
    """Rows of the table that a vehicle's simulator publishes, without the commands."""
    steered = [h for h in vehicle.hubs if vehicle.spec.axles[vehicle.axle_of_hub(h)].steered]
    rows = channels_for(vehicle.hubs, vehicle.tires, vehicle.units, steered)
    # tire forces go out as one message of markers; bags of a run hold them as channels
    kept_back = ("input", "tire_contact")
    published = [row for row in rows if row.group not in kept_back and row.place]
    return (*published, *(_vertical_speed(unit) for unit in vehicle.units))


def _vertical_speed(unit: str) -> Channel:
    """Completes the twist; no column of recordings, as no instrument of a test gives it."""
    frame = f"{unit}/base_link"
    place = Place(f"{unit}/odometry", ODOMETRY, "twist.twist.linear.z", "map", frame)
    return Channel(
        f"{unit}_vz_mps", "m/s", f"upward speed of the {unit}", unit, "simulator",
        -math.inf, math.inf, place, standard=False, part=unit,
    )  # fmt: skip


def group_of(ros_type: str, channel: Channel) -> str:
    """The group a message belongs to."""
    by_type = {ODOMETRY: "odometry", IMU: "imu", JOINT_STATE: "joint_states"}
    if ros_type == FLUID_PRESSURE:
        return channel.group
    return by_type.get(ros_type, "yaw_rate")


@dataclass(frozen=True)
class Batch:
    """The messages of all groups that share one rate.

    Attributes:
        every: published each so many ticks.
        groups: names of the groups.
        encoder: turns the values into serialised messages.
    """

    every: int
    groups: tuple[str, ...]
    encoder: RowEncoder


class OutputTable:
    """Knows all outputs of a vehicle, and turns a model's output vector into messages.

    Args:
        vehicle: a loaded vehicle.
        output_names: names of the model's output vector.
        every: ticks between two messages, by group.
    """

    def __init__(
        self, vehicle: Vehicle, output_names: Sequence[str], every: Mapping[str, int]
    ) -> None:
        self.display = DisplayJoints(vehicle, output_names)
        rows = (*output_channels(vehicle), *self.display.channels)
        names = [*output_names, *(row.name for row in self.display.channels)]
        if len(set(names)) < len(names):
            raise ValueError("an output and a display joint share a name")
        self._columns = np.array([names.index(row.name) for row in rows], dtype=np.intp)
        variances = {row.name: VARIANCES[row.unit] for row in rows}
        self.batches = tuple(
            Batch(period, groups, _encoder(rows, groups, variances))
            for period, groups in _by_period(every).items()
        )

    def read_by(self, topics: Collection[str]) -> tuple[Batch, ...]:
        """The batches with those of their messages that somebody reads; empty ones left out."""
        cut = (replace(batch, encoder=batch.encoder.only(topics)) for batch in self.batches)
        return tuple(batch for batch in cut if batch.encoder.slots)

    def needs_display(self, batches: Sequence[Batch]) -> bool:
        """Whether a message of these batches holds a joint that only displays need."""
        first = len(self._columns) - len(self.display.channels)
        shown = range(first, len(self._columns))
        return any(batch.encoder.fills_from(shown) for batch in batches)

    @property
    def types(self) -> dict[str, str]:
        """Message type by relative topic."""
        return {slot.topic: slot.ros_type for b in self.batches for slot in b.encoder.slots}

    def values(self, outputs: FloatArray, display: FloatArray) -> FloatArray:
        """Values of all rows.

        Args:
            outputs: the model's output vector.
            display: values of the display joints.
        """
        return np.concatenate((outputs, display))[self._columns]


def _by_period(every: Mapping[str, int]) -> dict[int, tuple[str, ...]]:
    periods = sorted(set(every.values()))
    return {p: tuple(group for group in every if every[group] == p) for p in periods}


def _encoder(
    rows: Sequence[Channel], groups: Sequence[str], variances: Mapping[str, float]
) -> RowEncoder:
    # All batches take the same vector: rows that are not published in a batch lose their places.
    return RowEncoder([_cut(row, groups) for row in rows], variances=variances)


def _cut(row: Channel, groups: Sequence[str]) -> Channel:
    kept = [place for place in row.places if group_of(place.ros_type, row) in groups]
    return replace(row, place=kept[0] if kept else None, copies=tuple(kept[1:]))
