# A prediction with its band
# φ(z) at a time at which nobody measured, with the 95 % band that follows from the noise of the data.
import matplotlib.pyplot as plt
import numpy as np

import shearfront as sf

truth = sf.Scene(shear_rate=sf.Exponential(2.0, 0.4), initial=sf.Step(0.5))
data = truth.observe([0.2, 0.4, 0.6], np.linspace(0.1, 0.9, 9), quantity="bin", width=0.1, noise=0.05, seed=2)
start = truth.with_(shear_rate__amplitude=1.0, shear_rate__decay=1.0)
found = sf.fit(start, data, ["shear_rate.amplitude", "shear_rate.decay"])
z = np.linspace(0, 1, 201)
p = found.predict([1.0], z)
figure, ax = plt.subplots(figsize=(4.6, 4.2), layout="constrained")
ax.fill_betweenx(z, p.phi_lower[0], p.phi_upper[0], color=sf.pictures.COLOURS[0], alpha=0.3, linewidth=0, label="95 %")
ax.plot(p.phi[0], z, color=sf.pictures.COLOURS[0], label="prediction")
ax.plot(truth.phi(z, 1.0), z, "--", color=sf.pictures.COLOURS[1], label="truth")
ax.set(xlabel="φ at t = 1", ylabel="z")
ax.legend(frameon=False)
