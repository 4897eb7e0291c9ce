"""The table of channels: one row says everything about one measured or commanded quantity.

A row holds the CSV column, the unit, the ROS topic (relative to the truck's namespace), the
message type, the field in it, the frame, and how the message's number follows from the channel's
(``message = sign * channel + offset``: pressures are gauge here and absolute in
``sensor_msgs/FluidPressure``). CSV, bag, node, comparison and diagnosis all walk this table.

Field paths: ``data``; ``pose.pose.position.x``; ``pose.pose.orientation:yaw`` (an angle kept as a
quaternion); ``velocity[steer_left_spin]`` (an entry of a JointState, by joint name).
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

from truck_blowout_sim.recordings.channel import (
    ATMOSPHERE_PA,
    DEFAULT_HUBS,
    DEFAULT_NAMESPACE,
    DEFAULT_TIRES,
    FLOAT64,
    FLUID_PRESSURE,
    HIGHEST_BRAKE_PA,
    IMU,
    INPUT_NAMES,
    JOINT_STATE,
    LOWEST_GAUGE_PA,
    ODOMETRY,
    STRING,
    UNITS,
    WRENCH,
    Channel,
    Place,
)

__all__ = [
    "ATMOSPHERE_PA",
    "BLOWOUT_EVENT",
    "DEFAULT_HUBS",
    "DEFAULT_NAMESPACE",
    "DEFAULT_TIRES",
    "FLOAT64",
    "FLUID_PRESSURE",
    "IMU",
    "INPUT_NAMES",
    "JOINT_STATE",
    "ODOMETRY",
    "STRING",
    "UNITS",
    "WRENCH",
    "Channel",
    "Place",
    "by_name",
    "channels_for",
]

BLOWOUT_EVENT = Channel(
    name="blowout",
    unit="",
    quantity="name of the tire blown, at the instant it is blown",
    group="event",
    instrument="trigger",
    lowest=-math.inf,
    highest=math.inf,
    place=Place("blowout", STRING, "data"),
)
"""The one row whose values are names; :func:`channels_for` lists the numeric ones."""


def channels_for(
    hubs: Sequence[str] = DEFAULT_HUBS,
    tires: Sequence[str] = DEFAULT_TIRES,
    units: Sequence[str] = UNITS,
    steered_hubs: Sequence[str] | None = None,
) -> tuple[Channel, ...]:
    """Expand the table for a vehicle.

    Args:
        hubs: hub names, e.g. ``vehicle.hubs``.
        tires: tire names, e.g. ``vehicle.tires``.
        units: bodies, ``("tractor",)`` or ``("tractor", "trailer")``.
        steered_hubs: hubs that have a road-wheel steer angle; by default those on a steer axle
            (name begins with ``steer_``).

    Returns:
        Rows in the order of the CSV columns, the standard ones first, then the extras.
    """
    steered = steered_hubs
    if steered is None:
        steered = [hub for hub in hubs if hub.startswith("steer_")]
    rows: list[Channel] = list(_INPUTS)
    for unit in units:
        rows += _body_rows(unit)
    rows += [_hub_speed(hub) for hub in hubs]
    rows += [_pressure("tire", tire) for tire in tires]
    rows += [_pressure("chamber", hub) for hub in hubs]
    rows += [_height(unit) for unit in units]
    if len(units) > 1:
        rows.append(_joint("articulation_rad", "articulation",
                           "articulation angle, trailer minus tractor yaw"))
    rows += [_joint(f"{hub}_steer_rad", f"{hub}_steer", f"road-wheel steer of hub {hub}", hub)
             for hub in steered]  # fmt: skip
    rows += [_joint(f"hub_spin_angle_{hub}_rad", f"{hub}_spin", f"spin angle of hub {hub}", hub)
             for hub in hubs]  # fmt: skip
    rows += [row for tire in tires for row in _contact_rows(tire)]
    return tuple(rows)


def by_name(channels: Iterable[Channel]) -> dict[str, Channel]:
    """Index rows by channel name."""
    return {channel.name: channel for channel in channels}


def _input(name: str, unit: str, topic: str, quantity: str, lowest: float, highest: float,
           instrument: str) -> Channel:  # fmt: skip
    place = Place(topic, FLOAT64, "data")
    return Channel(name, unit, quantity, "input", instrument, lowest, highest, place)


def _control_pressure(circuit: str) -> Channel:
    # std_msgs/Float64 has no convention for pressures: the command topics are gauge.
    return _input(
        f"brake_pressure_{circuit}_pa", "Pa", f"brake_pressure/{circuit}",
        f"control pressure of the {circuit} circuit, gauge", LOWEST_GAUGE_PA, HIGHEST_BRAKE_PA,
        "brake pressure gauges",
    )  # fmt: skip


_INPUTS = (
    _input("steering_wheel_angle_rad", "rad", "steering_wheel_angle",
           "hand-wheel angle, left positive", -50.0, 50.0, "hand wheel"),
    _input("throttle", "1", "throttle", "throttle, 0 to 1", -0.05, 1.05, "throttle"),
    *(_control_pressure(circuit) for circuit in ("steer", "drive", "trailer")),
)  # fmt: skip

_ANGLE_FIELD = "pose.pose.orientation:"
_SPEED_MPS, _RATE_RADPS, _ACCELERATION_MPS2, _POSITION_M = 200.0, 50.0, 1000.0, 1.0e7

# column stem, unit, words, bound, odometry field, imu field (the first filled one is read)
_BODY = (
    ("x_m", "m", "position along map x", _POSITION_M, "pose.pose.position.x", ""),
    ("y_m", "m", "position along map y", _POSITION_M, "pose.pose.position.y", ""),
    ("yaw_rad", "rad", "heading", 1.0e4, _ANGLE_FIELD + "yaw", "orientation:yaw"),
    ("roll_rad", "rad", "roll angle, left side up positive", math.pi,
     _ANGLE_FIELD + "roll", "orientation:roll"),
    ("pitch_rad", "rad", "pitch angle, nose down positive", math.pi,
     _ANGLE_FIELD + "pitch", "orientation:pitch"),
    ("vx_mps", "m/s", "forward speed", _SPEED_MPS, "twist.twist.linear.x", ""),
    ("vy_mps", "m/s", "speed to the left", _SPEED_MPS, "twist.twist.linear.y", ""),
    ("yaw_rate_radps", "rad/s", "yaw rate", _RATE_RADPS,
     "twist.twist.angular.z", "angular_velocity.z"),
    ("roll_rate_radps", "rad/s", "roll rate", _RATE_RADPS,
     "twist.twist.angular.x", "angular_velocity.x"),
    ("pitch_rate_radps", "rad/s", "pitch rate", _RATE_RADPS,
     "twist.twist.angular.y", "angular_velocity.y"),
    ("ax_mps2", "m/s2", "specific force forward", _ACCELERATION_MPS2, "", "linear_acceleration.x"),
    ("ay_mps2", "m/s2", "specific force to the left", _ACCELERATION_MPS2,
     "", "linear_acceleration.y"),
    ("az_mps2", "m/s2", "specific force upward", _ACCELERATION_MPS2, "", "linear_acceleration.z"),
)  # fmt: skip


def _body_rows(unit: str) -> list[Channel]:
    frame = f"{unit}/base_link"
    rows = []
    for stem, si_unit, words, bound, odometry_field, imu_field in _BODY:
        what, comma, sign = words.partition(",")
        places = []
        if stem == "yaw_rate_radps":
            places.append(Place(f"{unit}/yaw_rate", FLOAT64, "data"))
        if imu_field.startswith("angular_velocity"):
            places.append(Place(f"{unit}/imu", IMU, imu_field, frame))
        if odometry_field:
            places.append(Place(f"{unit}/odometry", ODOMETRY, odometry_field, "map", frame))
        if imu_field and not imu_field.startswith("angular_velocity"):
            places.append(Place(f"{unit}/imu", IMU, imu_field, frame))
        instrument = "imu" if "rate" in stem or stem.startswith("a") else "odometry"
        rows.append(Channel(
            f"{unit}_{stem}", si_unit, f"{what} of the {unit}{comma}{sign}", unit,
            f"{unit} {instrument}", -bound, bound, places[0], tuple(places[1:]), part=unit,
        ))  # fmt: skip
    return rows


def _height(unit: str) -> Channel:
    frame = f"{unit}/base_link"
    place = Place(f"{unit}/odometry", ODOMETRY, "pose.pose.position.z", "map", frame)
    return Channel(
        f"{unit}_z_m", "m", f"height of the {unit}'s base_link", unit, f"{unit} odometry",
        -_POSITION_M, _POSITION_M, place, standard=False, part=unit,
    )  # fmt: skip


def hub_of(channel: str) -> str:
    """The hub's name in ``hub_speed_<hub>_radps``."""
    return channel.removeprefix("hub_speed_").removesuffix("_radps")


def _hub_speed(hub: str) -> Channel:
    place = Place("joint_states", JOINT_STATE, f"velocity[{hub}_spin]")
    return Channel(
        f"hub_speed_{hub}_radps", "rad/s", f"spin speed of hub {hub}", "hub_speed",
        f"tachometer {hub}", -1000.0, 1000.0, place, part=hub,
    )  # fmt: skip


def _pressure(kind: str, part: str) -> Channel:
    name, topic, words = {
        "tire": (f"tire_pressure_{part}_pa", f"tires/{part}/pressure", f"of tire {part}"),
        "chamber": (f"brake_chamber_{part}_pa", f"brake_chambers/{part}/pressure",
                    f"in the brake chamber of hub {part}"),
    }[kind]  # fmt: skip
    group = {"tire": "tire_pressure", "chamber": "brake_chamber"}[kind]
    highest = HIGHEST_BRAKE_PA if kind == "chamber" else 5.0e6
    place = Place(topic, FLUID_PRESSURE, "fluid_pressure", part, offset=ATMOSPHERE_PA)
    return Channel(
        name, "Pa", f"gauge pressure {words}", group, f"{kind} gauge {part}",
        LOWEST_GAUGE_PA, highest, place, part=part,
    )  # fmt: skip


def _joint(name: str, joint: str, quantity: str, part: str = "") -> Channel:
    place = Place("joint_states", JOINT_STATE, f"position[{joint}]")
    return Channel(
        name, "rad", quantity, "joint", joint, -1.0e9, 1.0e9, place, standard=False, part=part
    )


def _contact_rows(tire: str) -> list[Channel]:
    force, radius = f"tires/{tire}/force", f"tires/{tire}/loaded_radius"
    columns = (
        (f"tire_fx_{tire}_n", "N", "force along the wheel plane of tire {}",
         Place(force, WRENCH, "wrench.force.x", tire)),
        (f"tire_fy_{tire}_n", "N", "force across the wheel plane of tire {}, left positive",
         Place(force, WRENCH, "wrench.force.y", tire)),
        (f"tire_fz_{tire}_n", "N", "vertical load of tire {}",
         Place(force, WRENCH, "wrench.force.z", tire)),
        (f"tire_loaded_radius_{tire}_m", "m", "hub height above the road of tire {}",
         Place(radius, FLOAT64, "data")),
    )
    return [
        Channel(name, unit, words.format(tire), "tire_contact", "simulator",
                -1.0e9, 1.0e9, place, standard=False, part=tire)
        for name, unit, words, place in columns
    ]  # fmt: skip
