# A number of the whole bed against time: the mixing parameter, or the height of the bed.
#
# course.csv   t,H or t,E,Psi   as written by `shearfront solve --quantity`: a curve
# times.csv    the same: points on it
#
# Variables: quantity     'H' or 'Psi'
#            t_end        right end of the axis
#            has_points   1: times.csv is drawn
#            t_lowest, h_lowest   of the lowest bed; t_lowest = 0: not marked
width = 560
height = 380
load 'style.gp'
if (!exists("quantity")) quantity = 'H'
if (!exists("t_end")) {
  stats 'course.csv' using (column("t")) nooutput
  t_end = STATS_max
}
if (!exists("has_points")) has_points = 0
if (!exists("t_lowest")) t_lowest = 0

set title title noenhanced offset 0,0.2
set xlabel label(along_name, unit_t) offset 0,0.3
set xrange [0:t_end]
set xtics steps_of(t_end)
if (quantity eq 'H') {
  set ylabel label('height of the bed {/:Italic H}', unit_z) offset 0.5,0
  # Room below for the lowest bed; few tics, where letters are large.
  stats 'course.csv' using (column("H")) nooutput
  span = STATS_max > STATS_min ? STATS_max - STATS_min : 0.01 * STATS_max
  below = t_lowest > 0 ? (is_narrow ? 0.5 : 0.35) * span : 0.05 * span
  set yrange [STATS_min - below:STATS_max + 0.05 * span]
  set ytics steps_of(1.1 * span + below)
} else {
  set ylabel 'mixing parameter Ψ' offset 0.5,0
  set yrange [-0.02:1.02]
}
if (t_lowest > 0) {
  set arrow from t_lowest,graph 0 to t_lowest,h_lowest nohead lw 0.8 dt (8,6) lc rgb '#7f7f7f' back
  lowest_text = sprintf("lowest: {/:Italic H} = %.5g%s\nat {/:Italic t} = %.5g%s", h_lowest, unit_z eq '' ? '' : ' '.unit_z, t_lowest, unit_t eq '' ? '' : ' '.unit_t)
  if (t_lowest < 0.6 * t_end) {
    set label lowest_text at t_lowest,graph (is_narrow ? 0.2 : 0.16) offset 0.8,0 tc rgb '#505050'
  } else {
    set label lowest_text at t_lowest,graph (is_narrow ? 0.2 : 0.16) right offset -0.8,0 tc rgb '#505050'
  }
}
plot 'course.csv' using "t":(column(quantity)) with lines lw 2 lc rgb blue, \
  for [i=1:has_points] 'times.csv' using "t":(column(quantity)) with points pt 7 ps 0.5 lc rgb blue
