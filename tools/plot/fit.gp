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
#            times              of data 'profiles', words
if (!exists("data")) data = 'maps'
# A column of a page: panels below each other, and letters that can be read. All places are in points of the planned figure.
is_tall = exists("width_cm") && !exists("height_cm") && width_cm < 13
n_data_rows = is_tall && data eq 'profiles' && words(times) > 3 ? 2 : 1
planned_width = is_tall ? 430.0 : 720.0
planned_height = !is_tall ? 560.0 : n_data_rows == 2 ? 845.0 : 660.0
width = planned_width
height = planned_height
is_panels = 1
is_subtitle_below = is_tall
load 'style.gp'
across(points) = points / planned_width
up(points) = points / planned_height
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
fits(low, high, step, room) = n_tics(low, high, step) < 3 || n_tics(low, high, step) * (n_letters(high, step) + 1) <= room * width / (0.73 * letters)
wider(low, high, step, room) = fits(low, high, step, room) ? step : wider(low, high, round_up(1.5 * step), room)
tic_step(low, high, room) = wider(low, high, round_up((high - low) / 10.0), room)
# Axes at this place of the figure; labels lie outside.
place = "set lmargin at screen left; set rmargin at screen right; set bmargin at screen bottom; set tmargin at screen top"
# Room for the labels of heights, and how near to them the name of the axis comes: digits are wider than gnuplot takes them for.
z_step = round_up((z_high - z_low) / 6.0)
z_letters = n_letters(z_high, z_step)
has_fractions = strstrt(sprintf('%.6g', z_step), '.') > 0
z_offset = has_fractions ? 0.8 : 0
z_margin = across(58 + 9.4 * max(0, z_letters - (has_fractions ? 3 : 2)))
height_axis = "set yrange [z_low:z_high]; set ytics round_up((z_high - z_low) / 6.0)"

# Panels: the data above, below them the rate, and search or residuals beside it or below.
data_bottom = up(is_tall ? 455 : 314)
data_top = 1 - up(is_tall ? 64 : 64.4)
rate_bottom = up(is_tall ? 255 : 53)
rate_top = up(is_tall ? 385 : 224)
rate_right = is_tall ? 0.6 : 0.42
last_left = is_tall ? across(72) : 0.72
last_bottom = up(is_tall ? 52 : 53)
last_top = up(is_tall ? 178 : 224)

set multiplot title title noenhanced
load 'fit-'.data.'.gp'
load 'fit-rate.gp'
if (has_search) load 'fit-search.gp'
if (!has_search) load 'fit-residuals.gp'
unset multiplot
