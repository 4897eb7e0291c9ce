"""Where every part of a truck was, as a recording tells it; gaps are filled and said."""

from truck_blowout_sim.motion.motion import Motion, motion_of
from truck_blowout_sim.motion.shown import Shown, shown
from truck_blowout_sim.motion.tracks import UnitTrack
from truck_blowout_sim.motion.wheels import WheelTrack

__all__ = ["Motion", "Shown", "UnitTrack", "WheelTrack", "motion_of", "shown"]
