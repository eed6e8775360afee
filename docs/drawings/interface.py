# At an interface
# A jump of s a from 2.4 (below) to 0.31 (above). Left: the two fluxes. What comes down from above with φ = 0.3 has the flux of
# the dashed line; below the interface the same flux belongs to φ = 0.028 (and to 0.972, which waves cannot carry away from
# there). No more than the lowest point of the flatter curve ever passes. Right: φ around z = 0.29 when the fan has crossed: φ
# jumps, the flux does not.
import matplotlib.pyplot as plt
import numpy as np

import shearfront as sf

scene = sf.read("datasets/may-2010-piecewise/scene.toml")
phi = np.linspace(0, 1, 301)
figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.8), layout="constrained")
for a, name, colour in ((2.4, "below, s a = 2.4", sf.pictures.COLOURS[0]), (0.31, "above, s a = 0.31", sf.pictures.COLOURS[1])):
    left.plot(phi, a * scene.flux(phi), color=colour, label=name)
F = 0.31 * 0.3 * (0.3 - 1)
state = (1 - np.sqrt(1 + 4 * F / 2.4)) / 2
left.axhline(F, color="grey", linestyle="--", linewidth=0.8)
left.plot([state], [F], "o", color=sf.pictures.COLOURS[0])
left.plot([0.3], [F], "o", color=sf.pictures.COLOURS[1])
left.set(xlabel="φ", ylabel="s a f(φ)", ylim=(-0.3, 0.01))
left.legend(frameon=False, loc="lower right", fontsize="small")
sf.pictures.profiles(scene.solve([0, 1.2, 2.0], np.linspace(0.1, 0.5, 801)), right)
