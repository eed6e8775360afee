# With and without diffusion
# The shear cell of May, Shearer and Daniels, without diffusion (left) and with D = 0.01 (right): fronts become layers of finite
# width, and the bed is never quite segregated.
import matplotlib.pyplot as plt

import shearfront as sf

sharp = sf.read("datasets/may-2010-piecewise/scene.toml")
soft = sf.read("datasets/may-2010-diffusion/scene-1e-2.toml")
figure, axes = plt.subplots(1, 2, figsize=(10, 4), layout="constrained")
sf.pictures.map(sharp, 8, axes[0])
sf.pictures.map(soft, 8, axes[1], method="crank-nicolson")
