"""Where and when something acts: a wrench, a wheel, a stance, a tone."""
