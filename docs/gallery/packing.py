# A scheme that lets grains pile up beyond the solid fraction
# Large grains rise into a bed that is looser above z = 0.56. How far φ exceeds c in the fullest cell: upwind, a published scheme,
# lets it when waves pass the jump of c, by up to 0.30; godunov, made for this case, does not.
import matplotlib.pyplot as plt
import numpy as np

import shearfront as sf

scene = sf.read("datasets/packing-example-4/scene-large.toml")
t, z = np.linspace(0, 1.5, 301), np.linspace(0.00125, 0.99875, 400)
figure, ax = plt.subplots(figsize=(5.6, 3.6), layout="constrained")
for i, method in enumerate(("upwind", "godunov")):
    beyond = (scene.solve(t, z, method=method, cells=400).phi - scene.solid_fraction(z)).max(axis=1)
    ax.plot(t, beyond.clip(min=0), color=sf.pictures.COLOURS[i], label=method)
ax.set(xlabel="t", ylabel="largest φ - c")
ax.legend(frameon=False)
