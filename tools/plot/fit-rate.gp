# s a(z) of the start and of the estimate with its 95 % band; the legend stands to the right of the panel.
#
# rate.csv       z,a,lower,upper   of the estimate, bottom to top, a layer by its two ends. lower = upper: no unknown has a
#                part in a there; empty: an unknown without error bars has
# start.csv      z,a   of the start of the search
# truth.csv      z,a   of the scene the data were made from
# model1.csv, model2.csv, ...   z,a   of other models of the same data
# interfaces.csv z_lower,z_upper,a_lower,a_upper   where interfaces lie with 95 %
#
# Variables: those of fit.gp, and
#            is_rate_unknown   1 if anything about s or a was
#            band_name    '95 % band', or by what
#            has_truth    1 if there is truth.csv
#            n_models     other models; model_name_1, model_name_2, ... are their names, model_name_0 that of the estimate
#            estimates    'values[0]=2.4±0.1 ...', words
#            rate_symbol       '{/:Italic a}' or with the scale '{/:Italic s} {/:Italic a}'
if (!exists("is_rate_unknown")) is_rate_unknown = 1
if (!exists("rate_symbol")) rate_symbol = '{/:Italic a}'
if (!exists("estimates")) estimates = ''
if (!exists("has_truth")) has_truth = 0
if (!exists("band_name")) band_name = '95 % band'
if (!exists("n_models")) n_models = 0
n_models = int(n_models)
model_file(j) = sprintf('model%d.csv', j)
model_name(j) = value(sprintf('model_name_%d', j))
model_colour(j) = word(many_colours, 2 + (j - 1) % 11)
most_linear = 20   # a that varies by more gets a logarithmic axis
widest_band = 4    # a band that goes on beyond so many times the curve is cut off

load 'panel.gp'
eval set_subtitle
# The estimates below the legend, where they are few.
estimates_text = ''
if (n_models > 3) { estimates = '' }  # no room
do for [word_of_them in estimates] { estimates_text = estimates_text . word_of_them . "\n" }
longest_estimate = 0
do for [word_of_them in estimates] { longest_estimate = max(longest_estimate, strlen(word_of_them)) }
# As wide as the room before the edge, or the panel on the right, whose label begins at 0.62 of the figure.
estimates_size = 0.7 * letters * min(1, (is_tall ? 30.0 : 20.5) / max(longest_estimate, 1))
n_entries = 3 + has_truth + n_models
entry_size = min(1, (is_tall ? 5.0 : 6.0) / n_entries)
entry_spacing = n_entries > 5 ? 1.0 : 1.2
legend_bottom = rate_top - up(4 + 14.5 * entry_spacing * max(entry_size, 0.55) * n_entries)
set label 1001 estimates_text noenhanced at screen rate_right+0.02,legend_bottom-up(6+4.6*words(estimates)) left font sprintf(',%.2f', estimates_size) textcolor rgb '#303030'
left = z_margin
right = rate_right
bottom = rate_bottom
top = rate_top
eval place

# Rows of the file, with lower = upper = a where there is no band.
stats 'rate.csv' using (column("z")) nooutput
n_rows = STATS_records
array zs[n_rows]
array rates[n_rows]
array lowers[n_rows]
array uppers[n_rows]
array kinds[n_rows]
known = 0
banded = 1
open = 2
kind(lower, upper) = lower eq '' ? open : lower eq upper ? known : banded
stats 'rate.csv' using (i = int($0) + 1, zs[i] = column("z"), rates[i] = column("a"), \
  kinds[i] = kind(strcol("lower"), strcol("upper")), \
  lowers[i] = kinds[i] == open ? rates[i] : column("lower"), uppers[i] = kinds[i] == open ? rates[i] : column("upper"), 0) nooutput
count(k) = sum [i=1:n_rows] (kinds[i] == k)

# The axis: all of start and estimate, and the band as far as it is not far away.
stats 'rate.csv' using (column("a")) nooutput
low = STATS_min
high = STATS_max
if (is_rate_unknown) {
  stats 'start.csv' using (column("a")) nooutput
  low = min(low, STATS_min)
  high = max(high, STATS_max)
}
if (has_truth) {
  stats 'truth.csv' using (column("a")) nooutput
  low = min(low, STATS_min)
  high = max(high, STATS_max)
}
do for [j=1:n_models] {
  stats model_file(j) using (column("a")) nooutput
  low = min(low, STATS_min)
  high = max(high, STATS_max)
}
is_logarithmic = high > most_linear * low
least = low / widest_band
most = high * (is_logarithmic ? widest_band : 2)
do for [i=1:n_rows] {
  low = min(low, max(lowers[i], least))
  high = max(high, min(uppers[i], most))
}
low = is_logarithmic ? low / 1.15 : 0
high = high * (is_logarithmic ? 1.15 : 1.05)

# Up along the lower edge, down along the upper one.
set print $band
do for [i=1:n_rows] { print sprintf('%.9g,%.9g', clamp(lowers[i], low, high), zs[i]) }
do for [i=n_rows:1:-1] { print sprintf('%.9g,%.9g', clamp(uppers[i], low, high), zs[i]) }
unset print

set xlabel label('segregation velocity '.rate_symbol.'({/:Italic z})', unit_z eq '' || unit_t eq '' ? '' : unit_z.'/'.unit_t) offset 0,0.3
set ylabel label('height {/:Italic z}', unit_z) offset z_offset,0
eval height_axis
set xrange [low:high]
if (is_logarithmic) {
  set logscale x
  set format x high > 1e4 * low ? '10^{%T}' : '%g'
  set mxtics high > 1e4 * low ? 1 : 10
  every_decade = ceil(log10(high / low) * 5 * 0.73 * letters / ((right - left) * width))
  if (every_decade > 1) { set xtics 10**every_decade }
  if (high < 100 * low) {  # less than two powers of ten
    set xtics ()
    do for [k=floor(log10(low)):ceil(log10(high))] { do for [m in '1 2 5'] {
      if (m * 10.0**k >= low && m * 10.0**k <= high) { set xtics add (sprintf('%g', m * 10.0**k) m * 10.0**k) }
    } }
  }
} else {
  set xtics tic_step(low, high, right - left)
}
# One column beside the other panel: many models get smaller letters.
entry_font = sprintf(',%.2f', letters * max(entry_size, 0.55))
set key at screen right+0.012,top left top vertical Left reverse samplen 1.8 spacing entry_spacing maxcols 1 font entry_font
set datafile nocolumnheaders
is_given = !is_rate_unknown || count(banded) + count(open) > 0  # else the whole known curve is the estimate
row(i) = int(column(0)) + 1
rate(k) = kinds[row(0)] == k ? column(2) : NaN
before(i) = i > 1 && kinds[i] != kinds[max(i - 1, 1)] ? i - 1 : 0  # where a step joins curves of two kinds
plot for [i=1:count(banded)>0] $band using 1:2 with filledcurves closed fs solid noborder lc rgb '#b3d4e8' title band_name, \
  'interfaces.csv' using (clamp(column(3), low, high)):1:(clamp(column(3), low, high)):(clamp(column(4), low, high)):1:2 skip 1 \
    with boxxyerror fs solid noborder fc rgb '#b3d4e8' notitle, \
  for [j=1:n_models] model_file(j) using 2:1 skip 1 with lines lw 1.3 lc rgb model_colour(j) title model_name(j), \
  for [i=1:is_rate_unknown && n_models == 0] 'start.csv' using 2:1 skip 1 with lines lw 1.3 lc rgb '#8c8c8c' title 'start', \
  'rate.csv' using (before(row(0)) ? rates[before(row(0))] : NaN):(zs[max(before(row(0)), 1)]):(column(2)-rates[max(before(row(0)), 1)]):(0) skip 1 \
    with vectors nohead lw 1.3 lc rgb blue notitle, \
  for [i=1:count(banded)>0] 'rate.csv' using (rate(banded)):1 skip 1 with lines lw 2.4 lc rgb blue title (n_models > 0 ? model_name(0) . ', best' : 'estimate'), \
  for [i=1:count(open)>0] 'rate.csv' using (rate(open)):1 skip 1 with lines lw 2.4 dt (4,2) lc rgb blue title 'no error bar', \
  for [i=1:count(known)>0] 'rate.csv' using (rate(known)):1 skip 1 with lines lw 2.4 lc rgb (is_given ? 'black' : blue) \
    title (is_given ? 'given' : 'estimate'), \
  for [i=1:has_truth] 'truth.csv' using 2:1 skip 1 with lines lw 1.3 dt (2,3) lc rgb 'black' title 'truth'
