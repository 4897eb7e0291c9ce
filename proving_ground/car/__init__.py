"""A car of a simulator that nobody here wrote: CommonRoad's multi-body model, 29 states.

M. Althoff and G. Wuersching, CommonRoad: Vehicle Models (2020); `commonroad-vehicle-models` on
PyPI. Its functions run unmodified; here they are compiled, driven, acted upon and recorded. Body
frame of that model: x forward, y right, z down; recordings have y left, z up.
"""
