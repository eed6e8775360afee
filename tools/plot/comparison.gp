# L1 error against wall time, both logarithmic: a panel per time, a line per method.
#
# comparison.csv   method,resolution,t,l1_error,wall_s,work   as written by `shearfront compare -o`
#
# Variables: times     words
#            methods   words
if (!exists("times")) times = '1'
if (!exists("methods")) methods = 'exact front-tracking front-tracking:linear engquist-osher godunov muscl'

n_times = words(times)
n_methods = words(methods)
is_tall = exists("width_cm") && !exists("height_cm") && width_cm < 13  # a column of a page
n_columns = is_tall ? (n_times > 3 ? 2 : 1) : n_times < 3 ? n_times : 3
n_rows = (n_times + n_columns - 1) / n_columns
title_height = 26
panel_height = is_tall ? 260 : 310
width = is_tall ? 230 * n_columns + (n_columns < 2 ? 190 : 0) : 330 * (n_columns < 2 ? 2 : n_columns)
legend_columns = is_tall && n_columns == 1 ? 1 : width / 210
legend_height = 24 * ((n_methods + legend_columns - 1) / legend_columns) + 14
height = title_height + n_rows * panel_height + legend_height
is_panels = 1
planned_height = height
load 'style.gp'
vertical_scale = height / planned_height
title_height = title_height * vertical_scale
panel_height = panel_height * vertical_scale
legend_height = legend_height * vertical_scale

colours = '#000000 #0072b2 #56b4e9 #d55e00 #e69f00 #009e73 #cc79a7 #7f7f7f'
shapes = '2 7 6 5 4 9 11 13'  # for print without colour
colour(i) = word(colours, (i - 1) % words(colours) + 1)
shape(i) = int(word(shapes, (i - 1) % words(shapes) + 1))

# Errors below rounding are drawn in one line, below the least error above it.
rounding = 1e-13
stats 'comparison.csv' using (column("wall_s")) nooutput
seconds_low = floor(log10(STATS_min))
seconds_high = max(ceil(log10(STATS_max)), seconds_low + 1)
has_rounding = 0
error_low = 1000
error_high = -1000
see_error(e) = e < rounding ? (has_rounding = 1, NaN) \
  : (error_low = min(error_low, floor(log10(e))), error_high = max(error_high, ceil(log10(e))), e)
stats 'comparison.csv' using (see_error(column("l1_error")), 1) nooutput
if (error_low > error_high) error_low = -2
error_high = max(error_high, error_low + 1)
place(e) = e < rounding ? 10.0**(error_low - 1) : e

set multiplot
set label 1 title noenhanced at screen 0.5,1-0.5*title_height/height center font sprintf(',%.2f', 13 * scale)
set logscale xy
set xrange [0.99*10.0**seconds_low:1.01*10.0**seconds_high]
set yrange [has_rounding ? 0.05*10.0**error_low : 0.99*10.0**error_low:1.01*10.0**error_high]
every_th = max(1, (seconds_high - seconds_low + 4) / 5)
set xtics ()
do for [k=seconds_low:seconds_high] { minor = (k - seconds_low) % every_th > 0; set xtics add (minor ? '' : sprintf('10^{%d}', k) 10.0**k minor) }
every_th = max(1, (error_high - error_low + 5) / 6)
set ytics ()
do for [k=error_low:error_high] { minor = (k - error_low) % every_th > 0; set ytics add (minor ? '' : sprintf('10^{%d}', k) 10.0**k minor) }
if (has_rounding) set ytics add ('rounding' 10.0**(error_low - 1))
set grid xtics ytics lc rgb '#e4e4e4' lw 0.6
set xlabel 'wall time (s)' offset 0,0.4
set ylabel '{/:Italic L}^1 error of φ' offset 0.8,0
set tmargin 2.4
do for [k=1:n_times] {
  t = real(word(times, k))
  i_column = (k - 1) % n_columns
  i_row = (k - 1) / n_columns
  set size 1.0/n_columns,1.0*panel_height/height
  set origin 1.0*i_column/n_columns,1.0*(legend_height+(n_rows-1-i_row)*panel_height)/height
  set title sprintf('{/:Italic '.along.'} = %s', word(times, k)) . (unit_t eq '' ? '' : ' ' . unit_t) offset 0,-0.6
  # The first method on top.
  plot for [i=n_methods:1:-1] 'comparison.csv' \
    using (strcol("method") eq word(methods, i) && column("t") == t ? column("wall_s") : NaN):(place(column("l1_error"))) \
    with linespoints lc rgb colour(i) lw 1.6 pt shape(i) ps 0.7
  unset label 1
}

# The legend is a panel of its own, without axes.
load 'panel.gp'
unset border
unset tics
set xrange [0:1]
set yrange [0:1]
set lmargin 0
set rmargin 0
set tmargin 0
set bmargin 0
set origin 0,0
set size 1,1.0*legend_height/height
set key on at graph 0.5,1 center top horizontal Left reverse maxcols legend_columns samplen 2 spacing 1.2 width 1 noenhanced
plot for [i=1:n_methods] NaN with linespoints lc rgb colour(i) lw 1.6 pt shape(i) ps 0.7 title word(methods, i)
unset multiplot
