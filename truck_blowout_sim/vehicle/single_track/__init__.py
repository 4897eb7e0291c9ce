"""A vehicle stated in ten lines, and the rules of thumb that fill in the rest."""

from truck_blowout_sim.vehicle.single_track.fill import RULE, filled_in

__all__ = ["RULE", "filled_in"]
