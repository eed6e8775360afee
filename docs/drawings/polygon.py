# The flux as a polygon
# With corners at steps of 1/6 (left) the curve becomes a polygon, and the fan (right) six jumps with constant speeds, the slopes
# of its sides.
import matplotlib.pyplot as plt
import numpy as np

import shearfront as sf

scene = sf.Scene(shear_rate=sf.Piecewise([], [1]), initial=sf.Step(0.5))
figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.8), layout="constrained")
phi = np.linspace(0, 1, 201)
bed = scene.track(0.2)
bed.advance(0.45)
fronts = bed.fronts()
states = np.unique(np.concatenate([fronts["phi_below"], fronts["phi_above"]]))
left.plot(phi, scene.flux(phi), color="grey", linewidth=0.8)
left.plot(states, scene.flux(states), "o-", color=sf.pictures.COLOURS[1])
left.set(xlabel="φ", ylabel="f(φ)")
sf.pictures.fronts(bed, right)
