# A fit: what was observed beside what the estimate predicts, the shear rate with its 95 % band, and the search.
# The panels are drawn by fit-*.gp, which say what they read.
#
# Variables: data               'profiles', 'maps' or 'heights': the panel above
#            symbol             of what was measured: '{/:Italic φ}', '{/:Italic M}'
#            unit_t, unit_z, unit_value   as written, '' for none
#            z_low, z_high      bottom and top
#            value_low, value_high        range of what was measured
#            has_sigma          1 if residuals.csv has a column sigma
#            bin_width          of bins that are all as wide; 0 for other data
#            has_search         1: the search is drawn, 0: the residuals
width = 720
height = 560
is_panels = 1
load 'style.gp'
if (!exists("data")) data = 'maps'
if (!exists("symbol")) symbol = '{/:Italic φ}'
if (!exists("unit_value")) unit_value = ''
if (!exists("z_low")) z_low = 0
if (!exists("z_high")) z_high = 1
if (!exists("value_low")) value_low = 0
if (!exists("value_high")) value_high = 1
if (!exists("has_sigma")) has_sigma = 0
if (!exists("bin_width")) bin_width = 0
if (!exists("has_search")) has_search = 1

# Distance of tics at round numbers with room for their labels; `room` is the length of the axis in the figure.
n_tics(low, high, step) = floor(high / step) - ceil(low / step) + 1
n_letters(high, step) = max(strlen(sprintf('%.6g', step)), strlen(sprintf('%.6g', floor(high / step) * step)))
fits(low, high, step, room) = n_tics(low, high, step) < 3 || n_tics(low, high, step) * (n_letters(high, step) + 1) <= room * width / 8
wider(low, high, step, room) = fits(low, high, step, room) ? step : wider(low, high, round_up(1.5 * step), room)
tic_step(low, high, room) = wider(low, high, round_up((high - low) / 10.0), room)
# Axes at this place of the figure; labels lie outside.
place = "set lmargin at screen left; set rmargin at screen right; set bmargin at screen bottom; set tmargin at screen top"
# Room for the labels of heights, and how near to them the name of the axis comes: digits are wider than gnuplot takes them for.
z_step = round_up((z_high - z_low) / 6.0)
z_letters = n_letters(z_high, z_step)
has_fractions = strstrt(sprintf('%.6g', z_step), '.') > 0
z_offset = has_fractions ? 0.8 : 0
z_margin = 0.08 + 0.013 * max(0, z_letters - (has_fractions ? 3 : 2))
height_axis = "set yrange [z_low:z_high]; set ytics round_up((z_high - z_low) / 6.0)"

set multiplot title title noenhanced
load 'fit-'.data.'.gp'
load 'fit-rate.gp'
if (has_search) load 'fit-search.gp'
if (!has_search) load 'fit-residuals.gp'
unset multiplot
