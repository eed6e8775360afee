# The height of the bed
# Mixed grains pack closer: the bed sinks while it mixes and rises while it segregates. This is what a shear cell records.
import matplotlib.pyplot as plt
import numpy as np

import shearfront as sf

scene = sf.read("datasets/may-2010-bed-height/scene.toml")
t = np.linspace(0, 8, 300)
bed = scene.bed(t)
figure, (above, below) = plt.subplots(2, 1, figsize=(6, 5), sharex=True, layout="constrained")
above.plot(t, bed["height"], color=sf.pictures.COLOURS[0])
above.set_ylabel("height H")
below.plot(t, bed["mixing"], color=sf.pictures.COLOURS[1])
below.set(xlabel="t", ylabel="mixing Ψ")
