# Front tracking step by step
# Six moments of one run with six fronts in the fan. Above: all fronts so far, collisions as dots. Below: φ(z) at that moment.
import matplotlib.pyplot as plt

import shearfront as sf

scene = sf.read("datasets/may-2010-piecewise/scene.toml")
bed = scene.track(0.2)
figure, axes = plt.subplots(2, 6, figsize=(13, 5.2), layout="constrained", sharey=True)
for t, (above, below) in zip((0.0, 0.6, 1.0, 2.0, 4.0, 6.4516), axes.T):
    bed.advance(t)
    for f in bed.fronts():
        shock = abs(f["phi_above"] - f["phi_below"]) > 0.25
        above.plot(
            [f["t_begin"], f["t_end"]], [f["z_begin"], f["z_end"]], linewidth=2 if shock else 0.8,
            color=sf.pictures.PHI((f["phi_above"] + f["phi_below"]) / 2),
        )  # fmt: skip
    met = bed.collisions()
    above.plot(met["t"], met["z"], ".", color="black", ms=4)
    above.axhline(0.29, color="grey", linestyle="--", linewidth=0.6)
    above.axvline(t, color="grey", linewidth=0.6)
    above.set(xlim=(0, 6.6), title=f"t = {t:.3g}")
    below.plot(*bed.profile().line(), color=sf.pictures.COLOURS[0])
    below.set(xlim=(-0.05, 1.05), xlabel="φ")
axes[0, 0].set_ylabel("z")
axes[1, 0].set_ylabel("z")
