# A bottleneck
# A uniform mixture in two layers, the upper one sheared little. Large grains want to rise, and no more than its capacity passes:
# they pile up below the interface. Exact solution.
import shearfront as sf

scene = sf.read("datasets/bottleneck/scene.toml")
figure = sf.pictures.map(scene, 1.02 * scene.events().t_star).figure
