# Observed, fitted and residual over t and z: cells where the data lie on a grid, points elsewhere.
#
# cells.csv   t,z,t_low,t_high,z_low,z_high,observed,predicted   means over the observations in each cell
#
# Variables: those of fit.gp, and
#            are_cells   0: points at t, z
#            have_gaps   1: some cells are empty
#            dt, dz      by which cells reach under their neighbours drawn later, else the page shines through between them
if (!exists("are_cells")) are_cells = 1
if (!exists("have_gaps")) have_gaps = 0
before_last = is_tall ? 0.175 : 0.125  # between the panels, colours included
panel_width = ((is_tall ? 0.825 : 0.895) - z_margin - before_last) / 3
stats 'cells.csv' using (column("t_low")):(column("t_high")) nooutput
t_low = STATS_min_x < 0.2 * STATS_max_y ? 0 : STATS_min_x
t_high = are_cells ? STATS_max_y : 1.02 * STATS_max_y
if (!(t_high > t_low)) t_high = t_low + 1
dt = 0.003 * (t_high - t_low)
dz = 0.003 * (z_high - z_low)

# The colours of the residuals are symmetric; the few far out have the outermost colours. Below 0.4 % a fit is perfect.
stats 'cells.csv' using (column("observed") - column("predicted")) nooutput
largest = STATS_records > 0 ? max(abs(STATS_min), abs(STATS_max)) : 0
spread = STATS_records > 0 ? sqrt(STATS_sumsq / STATS_records) : 0
# Half of the limit, too, is a round number.
round_limit(x, p) = x <= p ? p : x <= 2 * p ? 2 * p : x <= 3 * p ? 3 * p : x <= 4 * p ? 4 * p : x <= 6 * p ? 6 * p : x <= 8 * p ? 8 * p : 10 * p
least_limit = max(min(largest, 2.2 * spread), 0.004 * (value_high - value_low))
limit = round_limit(0.9999 * least_limit, 10**floor(log10(least_limit)))
beyond(sign) = largest > 1.0001 * limit ? sign : ''
value_colours = "set cbrange [value_low:value_high]; set cbtics round_up((value_high - value_low) / 5.0)"
residual_colours = "set cbrange [-limit:limit]; set cbtics (beyond('≤').sprintf('−%.4g', limit) -limit, ".\
  "sprintf('−%.4g', limit / 2) -limit / 2, '0' 0, sprintf('%.4g', limit / 2) limit / 2, beyond('≥').sprintf('%.4g', limit) limit)"

do for [k=1:3] {
  load 'panel.gp'
  left = z_margin + (k - 1) * panel_width + (k == 1 ? 0 : k == 2 ? across(is_tall ? 17 : 32.4) : before_last)
  right = left + panel_width
  bottom = data_bottom
  top = data_top
  eval place
  set title word('observed fitted', k) . (k < 3 ? ' ' . label(symbol, unit_value) : 'observed − fitted') offset 0,-0.6
  set xlabel label(along_name, unit_t) offset 0,0.3
  set xrange [t_low:t_high]
  set xtics tic_step(t_low, t_high, panel_width)
  eval height_axis
  if (k == 1) {
    set ylabel label('height {/:Italic z}', unit_z) offset z_offset,0
    unset colorbox
  } else {
    set format y ''
    set colorbox vertical noborder user origin screen right+0.01,bottom size screen 0.012,top-bottom
  }
  eval "set palette defined (" . (k < 3 ? phi_palette : residual_palette) . ")"
  set cbtics scale 0 offset -0.8,0
  eval k < 3 ? value_colours : residual_colours
  if (have_gaps) { set object rectangle from graph 0,0 to graph 1,1 behind fs solid noborder fc rgb '#dcdcdc' }
  shown(i) = k == 1 ? column("observed") : k == 2 ? column("predicted") : column("observed") - column("predicted")
  if (are_cells) {
    plot 'cells.csv' using "t":"z":"t_low":(min(t_high, column("t_high") + dt)):"z_low":(column("z_high") + dz):(shown(0)) \
      with boxxyerror fs solid noborder fc palette
  } else {
    size = clamp(7 / sqrt(STATS_records + 1.0), 0.15, 0.6)
    plot 'cells.csv' using "t":"z" with points pt 7 ps size+0.08 lc rgb '#909090', \
      'cells.csv' using "t":"z":(shown(0)) with points pt 7 ps size lc palette
  }
  unset object
}
