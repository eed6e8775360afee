# Settling
# 15 % of spheres in a column half a metre high (Richardson and Zaki). The clear liquid grows from above, the sediment from
# below.
import shearfront as sf

column = sf.read("datasets/settling-column/scene.toml")
figure = sf.pictures.map(column, 300, method="front-tracking", resolution=0.002).figure
