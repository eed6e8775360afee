# A traffic light
# Density of cars on a road whose light at the end is red until t = 1: the queue grows backwards, then dissolves from its head.
import shearfront as sf

road = sf.read("datasets/traffic-red-light/scene.toml")
figure = sf.pictures.map(road, 3, method="front-tracking", resolution=0.002).figure
figure.axes[0].set(ylabel="z, along the road")
