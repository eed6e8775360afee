# Bootstrap
# 300 synthetic data sets, each fitted anew: what the noise leaves possible. Cross: the estimate; circle: the truth.
import matplotlib.pyplot as plt
import numpy as np

import shearfront as sf

truth = sf.Scene(shear_rate=sf.Exponential(2.0, 0.4), initial=sf.Step(0.5))
data = truth.observe([0.2, 0.4, 0.6], np.linspace(0.1, 0.9, 9), quantity="bin", width=0.1, noise=0.05, seed=2)
found = sf.fit(truth, data, ["shear_rate.amplitude", "shear_rate.decay"], start=[1.0, 1.0])
drawn = found.bootstrap(300, seed=1).estimates
figure, ax = plt.subplots(figsize=(4.6, 4.2), layout="constrained")
ax.plot(*drawn.T, ".", ms=3, color=sf.pictures.COLOURS[0])
ax.plot(*found.estimates, "x", ms=9, color=sf.pictures.COLOURS[1])
ax.plot(2.0, 0.4, "o", mfc="none", ms=9, color="black")
ax.set(xlabel="amplitude", ylabel="decay")
