# Three models of the same data
# s a(z) by each of the three fits, with 95 % bands, and the truth dashed. The bands of the wrong models do not hold the truth:
# they know nothing of being wrong.
import matplotlib.pyplot as plt

import shearfront as sf

truth = sf.read("datasets/paper-example-5/scene.toml")
data = "datasets/paper-example-5/observations-bin-noise-0.01.csv"
models = {
    "exponential": (sf.Exponential(3, 0.5), ["shear_rate.amplitude", "shear_rate.decay"]),
    "one layer": (sf.Piecewise([], [1]), ["shear_rate.values"]),
    "four layers": (sf.Piecewise([0.25, 0.5, 0.75], [1, 1, 1, 1]), ["shear_rate.values"]),
}
figure, axes = plt.subplots(1, 3, figsize=(10, 3.8), layout="constrained", sharey=True)
for ax, (name, (rate, unknown)) in zip(axes, models.items()):
    fit = sf.fit(truth.with_(shear_rate=rate), data, unknown)
    sf.pictures.rate(fit, ax, truth=truth)
    ax.set(title=f"{name}: misfit {fit.misfit:.4g}", xlim=(0, 7))
