# A scheme that lets grains pile up beyond the solid fraction
# Large grains rise into a bed that is looser above z = 0.56 (grey line: c). Upwind lets φ exceed c, as a published scheme does;
# godunov, made for this case, does not.
import matplotlib.pyplot as plt
import numpy as np

import shearfront as sf

scene = sf.read("datasets/packing-example-4/scene-large.toml")
z = np.linspace(scene.bottom, scene.top, 401)
figure, ax = plt.subplots(figsize=(4.6, 4.2), layout="constrained")
ax.plot(scene.solid_fraction(z), z, color="grey", label="c(z)")
for i, method in enumerate(("upwind", "godunov", "front-tracking")):
    ax.plot(scene.solve([0.4], z, method=method).phi[0], z, color=sf.pictures.COLOURS[i], label=method)
ax.set(xlabel="φ at t = 0.4", ylabel="z")
ax.legend(frameon=False, fontsize="small")
