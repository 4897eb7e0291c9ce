"""What one row of the channel table is, and the names of the default truck's parts."""

from __future__ import annotations

from dataclasses import dataclass

ATMOSPHERE_PA = 101325.0
"""Standard atmosphere, the zero of every gauge pressure here."""

DEFAULT_NAMESPACE = "/truck"
UNITS = ("tractor", "trailer")
_AXLES = ("drive_1", "drive_2", "trailer_1", "trailer_2")
_DUAL_HUBS = tuple(f"{axle}_{side}" for axle in _AXLES for side in ("left", "right"))
DEFAULT_HUBS = ("steer_left", "steer_right", *_DUAL_HUBS)
DEFAULT_TIRES = (
    "steer_left",
    "steer_right",
    *(f"{hub}_{place}" for hub in _DUAL_HUBS for place in ("outer", "inner")),
)

FLOAT64 = "std_msgs/msg/Float64"
STRING = "std_msgs/msg/String"
ODOMETRY = "nav_msgs/msg/Odometry"
IMU = "sensor_msgs/msg/Imu"
JOINT_STATE = "sensor_msgs/msg/JointState"
FLUID_PRESSURE = "sensor_msgs/msg/FluidPressure"
WRENCH = "geometry_msgs/msg/WrenchStamped"

INPUT_NAMES = (
    "steering_wheel_angle_rad",
    "throttle",
    "brake_pressure_steer_pa",
    "brake_pressure_drive_pa",
    "brake_pressure_trailer_pa",
)
"""The five commands, in the order of :meth:`Recording.inputs_at`."""

# A pressure sensor's zero may sit a little below the atmosphere: half a percent of 1 MPa.
LOWEST_GAUGE_PA = -5000.0
# Gauges of hydraulic brake lines measure up to 400 bar.
HIGHEST_BRAKE_PA = 4.0e7


@dataclass(frozen=True)
class Place:
    """Where a channel's number is found in a message."""

    topic: str
    ros_type: str
    field: str
    frame: str = ""
    child_frame: str = ""
    sign: float = 1.0
    offset: float = 0.0


@dataclass(frozen=True)
class Channel:
    """One row of the table.

    Attributes:
        name: CSV column and key in a ``Recording``, unit as suffix.
        unit: SI unit as text.
        quantity: what it is, in words.
        group: rows that belong together: ``input``, ``tractor``, ``trailer``, ``hub_speed``,
            ``tire_pressure``, ``brake_chamber``, ``joint``, ``tire_contact``.
        instrument: what measures it; channels of one instrument share delay and mounting.
        lowest, highest: bounds outside of which a number cannot be this quantity.
        place: where it lives in a bag; ``None`` for rows without one.
        copies: further messages that carry the same number; filled on writing, read only if
            ``place`` is absent.
        standard: a column of the public CSV format; the others are extras of the simulator.
        part: the unit, hub or tire it belongs to, empty for inputs.
    """

    name: str
    unit: str
    quantity: str
    group: str
    instrument: str
    lowest: float
    highest: float
    place: Place | None
    copies: tuple[Place, ...] = ()
    standard: bool = True
    part: str = ""

    @property
    def topic(self) -> str:
        """Topic relative to the truck's namespace, empty if it has none."""
        return self.place.topic if self.place else ""

    @property
    def ros_type(self) -> str:
        """ROS message type, empty if it has none."""
        return self.place.ros_type if self.place else ""

    @property
    def field(self) -> str:
        """Field path in the message, empty if it has none."""
        return self.place.field if self.place else ""

    @property
    def frame(self) -> str:
        """``frame_id`` of the message."""
        return self.place.frame if self.place else ""

    @property
    def sign(self) -> float:
        """Factor from channel to message."""
        return self.place.sign if self.place else 1.0

    @property
    def offset(self) -> float:
        """Message value of a channel value of zero."""
        return self.place.offset if self.place else 0.0

    @property
    def places(self) -> tuple[Place, ...]:
        """Every place the number is written to, the one it is read from first."""
        return ((self.place,) if self.place else ()) + self.copies
