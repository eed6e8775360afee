# Five layers from noisy means
# The rates a of five layers from means of φ over bins with noise 0.01 (Example 4 of the source paper), with the band that holds
# the rate with 95 %, and the truth dashed.
import matplotlib.pyplot as plt
import shearfront as sf

fit = sf.read_fit("datasets/paper-example-4/fit-bin-noise-0.01.toml").run()
figure, (left, right) = plt.subplots(1, 2, figsize=(8, 4.2), layout="constrained")
sf.pictures.fit(fit, left)
sf.pictures.rate(fit, right, truth=sf.read("datasets/paper-example-4/scene.toml"))
