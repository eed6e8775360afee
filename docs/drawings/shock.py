# A shock
# Large grains above small ones below: φ falls upwards from 0.9 to 0.3. Left: the lines of both sides run into each other, and
# one jump remains. Right: its speed is the slope of the chord between the two states on the flux.
import matplotlib.pyplot as plt
import numpy as np

import shearfront as sf

low, high = 0.9, 0.3
scene = sf.Scene(shear_rate=sf.Piecewise([], [1]), initial=sf.Pieces([0.4], [low, high]))
speed = low + high - 1
figure, (left, right) = plt.subplots(1, 2, figsize=(8, 3.6), layout="constrained")
for z in np.linspace(-0.3, 1.3, 33):
    state = low if z < 0.4 else high
    v = 2 * state - 1
    end = (0.4 - z) / (v - speed)  # where it meets the shock
    end = min(end, 1.0) if end > 0 else 1.0
    left.plot([0, end], [z, z + v * end], color=sf.pictures.PHI(state), linewidth=0.8)
left.plot([0, 1], [0.4, 0.4 + speed], color="black", linewidth=3)
left.set(xlabel="t", ylabel="z", xlim=(0, 1), ylim=(0, 1))
phi = np.linspace(0, 1, 201)
right.plot(phi, scene.flux(phi), color="black")
right.plot([high, low], scene.flux([high, low]), "o-", color=sf.pictures.COLOURS[1], linewidth=2)
right.set(xlabel="φ", ylabel="f(φ)")
