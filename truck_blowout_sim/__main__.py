"""`python -m truck_blowout_sim` is `truck-blowout`."""

from truck_blowout_sim.cli.start import main

if __name__ == "__main__":
    raise SystemExit(main())
