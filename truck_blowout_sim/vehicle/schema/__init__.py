"""The sections of vehicle, tire, blowout and road files."""
