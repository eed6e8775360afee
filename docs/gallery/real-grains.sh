# Grains that do not obey the equation
# A particle simulation and the best exponential a(z): data, fit, residuals in patches, and s a(z). Drawn by the program, which
# also warns.
shearfront fit datasets/dem-shear-cell-piecewise/fit-early-exponential.toml --plot picture.png > /dev/null 2>&1
