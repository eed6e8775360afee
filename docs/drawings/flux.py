# The flux and its slopes
# Left: f(φ) = φ (φ - 1), what passes a height for s a = 1; negative, because small grains move down. Its slope at φ is the
# speed of a wave of that concentration: pure large grains (φ = 0) send waves down, pure small ones (φ = 1) up. Right: the
# speeds.
import matplotlib.pyplot as plt
import numpy as np

import shearfront as sf

scene = sf.Scene(shear_rate=sf.Piecewise([], [1]), initial=sf.Step(0.5))
phi = np.linspace(0, 1, 201)
figure, (left, right) = plt.subplots(1, 2, figsize=(8, 3.4), layout="constrained")
left.plot(phi, scene.flux(phi), color="black")
for x in (0.0, 0.25, 0.5, 0.75, 1.0):
    slope, f = 2 * x - 1, float(scene.flux(x))
    d = np.array([-0.12, 0.12])
    left.plot(x + d, f + slope * d, color=sf.pictures.PHI(x), linewidth=2.5)
    right.plot([0, 1], [0, slope], color=sf.pictures.PHI(x), linewidth=2.5)
    right.annotate(f"φ = {x:g}", (1, slope), xytext=(4, -3), textcoords="offset points")
left.set(xlabel="φ", ylabel="f(φ)")
right.set(xlabel="t", ylabel="z", xlim=(0, 1.3))
