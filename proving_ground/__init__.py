"""Independent truth for the diagnosis: a tractor-semitrailer on MuJoCo with concealed effects.

Shares no equations with `truck_blowout_sim`: other multibody engine, other tire family (TMeasy),
other suspension detail, other integrator and step.
"""
