"""Which figure of the thesis is which: title, what its text states, what is drawn, from what.

The statements are those of the thesis's text (K. V. Chakravarthy, Ohio State University, 2013) in
our words; its own pictures are not reproduced.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

from matplotlib.figure import Figure

from truck_blowout_sim.report.style import Picture, styled
from truck_blowout_sim.report.thesis import record, sheet, tires, turns
from truck_blowout_sim.simulation.thesis_data import MAPS, RECORD, STEER, TURNS, ThesisData

Draw = Callable[[ThesisData, str], Figure]


@dataclass(frozen=True)
class Entry:
    """One figure.

    Attributes:
        title: caption.
        stated: what the text says of the original.
        needs: parts of `ThesisData`.
        draw: makes it.
    """

    title: str
    stated: str
    needs: tuple[str, ...]
    draw: Draw


def _turn(axle: str, *cases: str) -> Draw:
    return partial(turns.trajectories, axle=axle, cases=cases)


def _yaw(axle: str, case: str) -> Draw:
    return partial(turns.yaw_rates, axle=axle, case=case)


_STEP = (" Straight at 31 mph; from 2 s on 180 deg of hand wheel to the left; at 5 s the tires blow"
         " while the speed is held.")
FIGURES: dict[int, Entry] = {
    3: Entry("Speed of the test", "The driver held the throttle until about 3 s after the blowout,"
             " at about 55 mph; the truck coasted to about 50 mph at 5 s, when the trailer brakes"
             " were applied; the record ends at 10 s.", (RECORD,), record.record_speed),
    4: Entry("Yaw rate of the test", "About 2.5 deg/s counterclockwise about 1 s after the blowout;"
             " slightly clockwise for about 2 s; from about 3 s nominally 0.", (RECORD,),
             record.record_yaw),
    5: Entry("Steering of the test", "To the right: about 40 deg for about 1 s; from about 3 s held"
             " at about 25 deg.", (RECORD,), record.record_steer),
    6: Entry("Path of the test", "A near straight line over 1,053 ft, with a lateral displacement"
             " of about 16 ft.", (RECORD,), record.record_path),
    10: Entry("Axes of the simulator", "The simulator's own axis system; ours after ISO 8855 is"
              " the same: x forward, y left, z up.", (), partial(sheet.axis_system, kind="iso")),
    11: Entry("SAE axes", "The SAE vehicle axis system: x forward, y right, z down.", (),
              partial(sheet.axis_system, kind="sae")),
    12: Entry("Brake torque of the trailer axles at 60 mph", "A quadratic function of the chamber"
              " pressure, constant coefficients for 60 mph. The text prints none; ours are those of"
              " a 16.5 x 7 S-cam brake.", (), sheet.brake_torque),
    13: Entry("Spring of the steer axle", "NHTSA data at a static load of 12,000 lb. The text"
              " prints no numbers.", (), partial(sheet.spring, axle="steer")),
    14: Entry("Air spring of the drive axles", "Data at five loads: 12,000, 18,000, 24,000, 30,000"
              " and 35,000 lb. Our sheet has the rate at the test's load only.", (),
              partial(sheet.spring, axle="drive_1")),
    15: Entry("Spring of the trailer axles", "NHTSA data at a static load of 20,000 lb. The text"
              " prints no numbers.", (), partial(sheet.spring, axle="trailer_1")),
    16: Entry("Tire parameters in a blowout", "Cornering and camber stiffness fall; radial"
              " stiffness falls, then rises when the carcass meets the rim; rolling resistance and"
              " aligning torque rise.", (STEER,), sheet.blowout_parameters),
    17: Entry("Radius and stiffness of the transient tires", "The radius falls evenly from 491 to"
              " 300 mm within 0.5 s; the stiffness from 980 to 300 N/mm, then to 98,000 N/mm.",
              (STEER,), sheet.radius_and_stiffness),
    18: Entry("Lateral force, inflated tire", "A map over slip angle and load; the text prints no"
              " numbers. The thesis sheet's map is made from our tire formula.", (MAPS,),
              partial(tires.tire_figure, quantity="lateral", flat=False)),
    19: Entry("Lateral force, flat tire", "The map of the inflated tire, divided by 10.", (MAPS,),
              partial(tires.tire_figure, quantity="lateral", flat=True)),
    20: Entry("Aligning torque, inflated tire", "A map over slip angle and load; the text prints"
              " no numbers.", (MAPS,),
              partial(tires.tire_figure, quantity="aligning", flat=False)),
    21: Entry("Aligning torque, flat tire", "Larger than that of the inflated tire; the text does"
              " not say by how much. Our thesis sheet leaves it as it is.", (MAPS,),
              partial(tires.tire_figure, quantity="aligning", flat=True)),
    29: Entry("Hand wheel of test and simulations", "Test, TruckSim and HVE in SAE axes. Ours are"
              " driven by the record itself.", (STEER,), record.steer_angles),
    30: Entry("Hand wheel given to the simulation", "The same input, turned to the simulator's"
              " axes: left positive.", (STEER,), record.steer_input),
    31: Entry("Speed", "Simulated and recorded speeds are almost the same; they differ from"
              " 3 s on.", (STEER,), record.speeds),
    32: Entry("Speed error", "No more than 0.6 mph during 15 s.", (STEER,), record.speed_error),
    33: Entry("Lateral speed", "The error is no more than 0.5 mph, positive throughout, and falls"
              " with time.", (STEER,), record.lateral_speed),
    34: Entry("Yaw rate", "Similar responses; neither simulation shows the peak of about -2.5 deg/s"
              " about 1 s after the blowout.", (STEER,), record.yaw_rates),
    35: Entry("Paths", "Lateral positions differ by less than 1 ft (HVE) and about 3 ft"
              " (TruckSim).", (STEER,), record.paths),
    36: Entry("Longitudinal position error", "Less than 0.3 ft (HVE) and about 1.6 ft (TruckSim)"
              " over 1,053 ft.", (STEER,), record.position_error),
    37: Entry("Brake chamber pressures", "Only the four wheels of the trailer are braked; the"
              " operation of the ABS is clearly seen.", (STEER,), record.chambers),
    38: Entry("Trailer axle: paths", "Left (inner) duals: a smaller turn, at first the trailer yaws"
              " away. Right (outer) duals: a much larger radius." + _STEP, (TURNS,),
              _turn("trailer", "no blowout", "left duals", "right duals")),
    39: Entry("Trailer axle, left duals: yaw rates", "The effect is smaller than that of"
              " the outer tires.", (TURNS,), _yaw("trailer", "left duals")),
    40: Entry("Trailer axle, right duals: yaw rates", "The trailer continues to yaw"
              " counterclockwise; the effect is larger than that of the inner tires.", (TURNS,),
              _yaw("trailer", "right duals")),
    41: Entry("Drive axle: paths", "With either side blown the truck yaws more into the turn; more"
              " with the left duals." + _STEP, (TURNS,),
              _turn("drive", "no blowout", "left duals", "right duals")),
    42: Entry("Drive axle, left duals: yaw rates", "The truck yaws more than with the right duals"
              " blown.", (TURNS,), _yaw("drive", "left duals")),
    43: Entry("Drive axle, right duals: yaw rates", "The truck yaws more than without a blowout.",
              (TURNS,), _yaw("drive", "right duals")),
    44: Entry("Trailer axle, one dual or both: paths", "With the outer left tire alone the path is"
              " that without a blowout." + _STEP, (TURNS,),
              _turn("trailer", "no blowout", "left outer", "left duals")),
    45: Entry("Trailer axle, one dual: yaw rates", "The same as without a blowout: the other dual"
              " carries the wheel.", (TURNS,), _yaw("trailer", "left outer")),
}


@styled
def figure_picture(number: int, data: ThesisData) -> Picture:
    """One figure of the thesis from our data.

    Raises:
        KeyError: the thesis's figure of this number is no plot.
    """
    entry = FIGURES[number]
    figure = entry.draw(data, entry.stated)
    return Picture(f"figure_{number:02d}", f"Figure {number}. {entry.title}", entry.stated, figure)
