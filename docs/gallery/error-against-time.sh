# Error against time
# Every method on the same bed, from coarse to fine: L1 error of φ against seconds, drawn by the program.
shearfront compare datasets/may-2010-piecewise/scene.toml --times 0.5,6 --plot picture.svg > /dev/null
