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
panel_width = min(0.45, (0.97 - z_margin + gap) / n_times - gap)
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
  left = z_margin + (k - 1) * (panel_width + gap)
  right = left + panel_width
  bottom = 0.56
  top = 0.855
  eval place
  t = real(word(times, k))
  stats 'residuals.csv' using (column("t") == t ? column("observed") : NaN) nooutput
  n_points = STATS_records
  has_bars = has_sigma && n_points <= most_error_bars
  set title sprintf('{/:Italic '.along.'} = %.5g', t) . (unit_t eq '' ? '' : ' ' . unit_t) offset 0,-0.6
  set xlabel label(symbol, unit_value) offset 0,0.3
  set xrange [low-margin:high+margin]
  set xtics tic_step(low - margin, high + margin, panel_width)
  eval height_axis
  unset label
  unset arrow
  if (k == 1) {
    set ylabel label('height {/:Italic z}', unit_z) offset z_offset,0
    # The legend is one line above all panels; gnuplot's own would stand in two.
    first = has_bars ? 0.36 : 0.4
    second = has_bars ? 0.58 : 0.54
    set label '' at screen first,0.93 point pt 6 ps 0.45 lc rgb dark_grey
    if (has_bars) { set arrow from screen first-0.015,0.93 to screen first+0.015,0.93 heads size screen 0.005,90 lw 1 lc rgb dark_grey }
    set label 'observed' . (has_bars ? ' (95 %)' : '') at screen first+(has_bars ? 0.025 : 0.015),0.93 left
    set arrow from screen second,0.93 to screen second+0.035,0.93 nohead lw 2 lc rgb blue
    set label 'fitted' at screen second+0.045,0.93 left
  } else {
    set format y ''
  }
  size = n_points > 50 ? 0.3 : 0.45
  at(value) = column("t") == t ? value : NaN
  plot for [i=1:bin_width>0] 'residuals.csv' using (at(column("observed"))):(column("z")-bin_width/2):(0):(bin_width) with vectors nohead lw 2 lc rgb '#b0b0b0', \
    for [i=1:has_bars] 'residuals.csv' using (at(column("observed"))):"z":(error(0)) with xerrorbars pt 6 ps size lc rgb dark_grey, \
    for [i=1:!has_bars] 'residuals.csv' using (at(column("observed"))):"z" with points pt 6 ps size lc rgb dark_grey, \
    'fitted.csv' using (column(fitted)):"z" every ::((k-1)*n)::(k*n-1) with lines lw 2 lc rgb blue
}
