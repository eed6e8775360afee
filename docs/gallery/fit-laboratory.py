# a(z) from a laboratory's file
# A spreadsheet of small grains at 21 heights and 15 times: measured and fitted φ, and s a(z) with the band that holds it with
# 95 %. Dashed: the bed that made the data.
import matplotlib.pyplot as plt

import shearfront as sf

fit = sf.read_fit("datasets/lab-files/fit-percent.toml").run()
figure, (left, right) = plt.subplots(1, 2, figsize=(8, 4.2), layout="constrained")
sf.pictures.fit(fit, left, most_times=4)
sf.pictures.rate(fit, right, truth=sf.read("datasets/lab-files/truth.toml"))
