# Observed minus fitted: over the height, coloured by time, or of heights of the bed over time.
#
# residuals.csv   t,z,observed,predicted,residual[,sigma]   as written by `shearfront fit -o`
#
# Variables: those of fit.gp
load 'panel.gp'
left = last_left
right = is_tall ? 0.8 : 0.9
bottom = last_bottom
top = last_top
eval place
stats 'residuals.csv' using (column("residual")) nooutput
size = clamp(7 / sqrt(STATS_records + 1.0), 0.15, 0.5)
largest = 1.05 * max(max(abs(STATS_min), abs(STATS_max)), 1e-300)
set title 'observed − fitted' offset 0,-0.6
if (data eq 'heights') {
  set xlabel label(along_name, unit_t) offset 0,0.3
  set yrange [-largest:largest]
  set ytics round_up(largest / 2)
  set xzeroaxis lw 0.8 dt (8,6) lc rgb '#8c8c8c'
  plot 'residuals.csv' using "t":"residual" with points pt 7 ps size lc rgb blue
} else {
  stats 'residuals.csv' using (column("t")) nooutput
  set cbrange [STATS_min:STATS_max > STATS_min ? STATS_max : STATS_min + 1]
  set cblabel label(along_name, unit_t) offset 0.3,0
  set cbtics round_up(max(STATS_max - STATS_min, 1e-300) / 3) scale 0 offset -0.8,0
  set colorbox vertical noborder user origin screen right+0.01,bottom size screen 0.012,top-bottom
  eval "set palette defined (" . phi_palette . ")"
  set xrange [-largest:largest]
  set xtics tic_step(-largest, 1.2 * largest, 0.8 * (right - left))
  eval height_axis
  if (is_tall) { set ylabel label('height {/:Italic z}', unit_z) offset z_offset,0 }
  set yzeroaxis lw 0.8 dt (8,6) lc rgb '#8c8c8c'
  plot 'residuals.csv' using "residual":"z":"t" with points pt 7 ps size lc palette
}
