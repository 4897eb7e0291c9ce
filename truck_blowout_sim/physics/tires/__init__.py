"""What a tire does: vertical, slip lag, horizontal force, gas, blowout state."""
