# Observed points and fitted lines, one panel per time.
#
# residuals.csv   t,z,observed,predicted,residual[,sigma]   as written by `shearfront fit -o`
# fitted.csv      t,z,phi,M   of the estimate, as written by `shearfront solve -o`: the same heights at every time
#
# Variables: those of fit.gp, and
#            times    words, in the order of fitted.csv
#            fitted   'phi' or 'M'
sigmas = 1.96          # of a 95 % interval
most_error_bars = 40   # more of them hide the points
gap = 0.022
n_times = words(times)
n_columns = (n_times + n_data_rows - 1) / n_data_rows
panel_width = min(0.45, (0.97 - z_margin + gap) / n_columns - gap)
row_height = up(185)
error(i) = has_sigma ? sigmas * column("sigma") : 0
stats 'residuals.csv' using (column("observed") - error(0)):(column("observed") + error(0)) nooutput
low = min(value_low, STATS_min_x)
high = max(value_high, STATS_max_y)
margin = 0.03 * (high - low)
n_rows(file) = STATS_records
stats 'fitted.csv' using (column("z")) nooutput
n = STATS_records / n_times

do for [k=1:n_times] {
  load 'panel.gp'
  i_column = (k - 1) % n_columns
  is_lowest = k + n_columns > n_times
  left = z_margin + i_column * (panel_width + gap)
  right = left + panel_width
  top = 1 - up(81) - (k - 1) / n_columns * row_height
  bottom = n_data_rows == 1 ? data_bottom : top - up(115)
  eval place
  t = real(word(times, k))
  stats 'residuals.csv' using (column("t") == t ? column("observed") : NaN) nooutput
  n_points = STATS_records
  has_bars = has_sigma && n_points <= most_error_bars
  set title sprintf('{/:Italic '.along.'} = %.5g', t) . (unit_t eq '' ? '' : ' ' . unit_t) offset 0,-0.6
  if (is_lowest) { set xlabel label(symbol, unit_value) offset 0,0.3 }
  set xrange [low-margin:high+margin]
  set xtics tic_step(low - margin, high + margin, panel_width)
  eval height_axis
  unset label
  unset arrow
  if (i_column == 0) { set ylabel label('height {/:Italic z}', unit_z) offset z_offset,0 } else { set format y '' }
  if (k == 1) {
    # The legend is one line above all panels; gnuplot's own would stand in two.
    first = has_bars ? 0.5 - across(100) : 0.5 - across(72)
    second = has_bars ? 0.5 + across(58) : 0.5 + across(29)
    line = 1 - up(39)
    set label '' at screen first,line point pt 6 ps 0.45 lc rgb dark_grey
    if (has_bars) { set arrow from screen first-across(11),line to screen first+across(11),line heads size screen 0.005,90 lw 1 lc rgb dark_grey }
    set label 'observed' . (has_bars ? ' (95 %)' : '') at screen first+across(has_bars ? 18 : 11),line left
    set arrow from screen second,line to screen second+across(25),line nohead lw 2 lc rgb blue
    set label 'fitted' at screen second+across(32),line left
  }
  size = n_points > 50 ? 0.3 : 0.45
  at(value) = column("t") == t ? value : NaN
  plot for [i=1:bin_width>0] 'residuals.csv' using (at(column("observed"))):(column("z")-bin_width/2):(0):(bin_width) with vectors nohead lw 2 lc rgb '#b0b0b0', \
    for [i=1:has_bars] 'residuals.csv' using (at(column("observed"))):"z":(error(0)) with xerrorbars pt 6 ps size lc rgb dark_grey, \
    for [i=1:!has_bars] 'residuals.csv' using (at(column("observed"))):"z" with points pt 6 ps size lc rgb dark_grey, \
    'fitted.csv' using (column(fitted)):"z" every ::((k-1)*n)::(k*n-1) with lines lw 2 lc rgb blue
}
