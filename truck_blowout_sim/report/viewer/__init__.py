"""The page of `truck-blowout view`: a truck moving in three dimensions, in one HTML file."""

from truck_blowout_sim.report.viewer.content import RunToShow
from truck_blowout_sim.report.viewer.page import write_viewer

__all__ = ["RunToShow", "write_viewer"]
