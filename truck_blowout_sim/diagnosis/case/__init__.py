"""The case: runs, their noise, the numbers of the sheet, sensitivities, calibration, resume."""
