# Why points are bad and bins are good
# What a sensor at z = 0.88 would see at t = 1.5 against the rate of the highest of five layers. The value at a point jumps when
# the shock passes; its slope says nothing of that. The mean over a bin 0.1 wide slides, the amount below has a kink.
import matplotlib.pyplot as plt
import numpy as np

import shearfront as sf

scene = sf.read("datasets/paper-example-4/scene.toml")
rates = np.linspace(0.45, 0.62, 171)
beds = [scene.with_({"shear_rate.values[4]": a}) for a in rates]
point = [b.phi(0.88, 1.5) for b in beds]
bin_ = [(b.M(0.93, 1.5) - b.M(0.83, 1.5)) / 0.1 for b in beds]
below = [b.M(0.88, 1.5) for b in beds]
figure, axes = plt.subplots(1, 3, figsize=(10, 3.2), layout="constrained")
for ax, y, title in zip(axes, (point, bin_, below), ("φ at the point", "mean of φ over the bin", "M, the amount below")):
    ax.plot(rates, y, color=sf.pictures.COLOURS[0])
    ax.set(title=title, xlabel="rate of the highest layer")
