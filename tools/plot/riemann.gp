# The Riemann problem at an interface: flux curves of both layers with the states from bottom to top, and the waves.
#
# curves.csv  layer,phi,flux   the flux of the layer below (0) and above (1), two empty lines between
# path.csv    the same: the states on the way from bottom to top. Fans follow the curve, shocks their chord
# waves.csv   dz,phi,jump      how far each wave is at t_end, the mean of its states, and how much they differ
#
# Variables: t_end, z_low, z_high, z_interface
#            phi_outer_below, phi_inner_below, phi_inner_above, phi_outer_above   the states beyond and next to the interface
#            flux_outer_below, flux_outer_above, flux_interface                   and their fluxes
is_tall = exists("width_cm") && !exists("height_cm") && width_cm < 13  # a column of a page: one panel below the other
width = is_tall ? 430 : 720
height = is_tall ? 600 : 330
is_panels = 1
load 'style.gp'
least_shock = 0.02
below_colour = blue
above_colour = '#d55e00'

set multiplot
set label 1 title noenhanced at screen 0.5,(is_tall ? 0.98 : 0.965) center
# The flux plane.
set datafile nocolumnheaders
stats 'curves.csv' using 3 skip 1 nooutput
low = min(STATS_min, 0)
high = max(STATS_max, 0)
room = 0.08 * (high - low)
set lmargin at screen (is_tall ? 0.19 : 0.125)
set rmargin at screen (is_tall ? 0.85 : 0.5)
set bmargin at screen (is_tall ? 0.57 : 0.17)
set tmargin at screen (is_tall ? 0.89 : 0.84)
set xlabel 'concentration {/:Italic φ}' offset 0,0.3
set ylabel label('flux', unit_z eq '' || unit_t eq '' ? '' : unit_z.'/'.unit_t) offset 1.2,0
set xrange [phi_low-0.03*(phi_high-phi_low):phi_high+0.03*(phi_high-phi_low)]
set yrange [low-room:high+room]
if (phi_low == 0 && phi_high == 1) set xtics 0.2
set ytics round_up((high - low) / 5.0)
set arrow 1 from phi_low,flux_interface to phi_high,flux_interface nohead lw 0.8 dt (8,6) lc rgb grey back
# States that are the same have one name.
# The outer states above, the inner ones below their points.
name(text, phi, flux, up) = sprintf("set label '%s' at %.9g,%.9g point pt 7 ps 0.7 offset 0.6,%.1f front", text, phi, flux, up ? 0.7 : -0.8)
eval name('{/:Italic φ}_{below}', phi_outer_below, flux_outer_below, 1)
eval name('{/:Italic φ}_{above}', phi_outer_above, flux_outer_above, 1)
if (phi_inner_below != phi_outer_below) { eval name('{/:Italic φ}_−', phi_inner_below, flux_interface, 0) }
if (phi_inner_above != phi_outer_above) { eval name('{/:Italic φ}_+', phi_inner_above, flux_interface, 0) }
set key at graph 0.5,1.01 center bottom horizontal Left reverse samplen 1.6
set datafile nocolumnheaders
plot 'curves.csv' index 0 using 2:3 skip 1 with lines lw 1.2 lc rgb below_colour title 'layer below', \
  'curves.csv' index 1 using 2:3 with lines lw 1.2 lc rgb above_colour title 'layer above', \
  'path.csv' index 0 using 2:3 skip 1 with lines lw 3.4 lc rgb below_colour notitle, \
  'path.csv' index 1 using 2:3 with lines lw 3.4 lc rgb above_colour notitle

# The waves.
unset label
unset arrow
load 'panel.gp'
set lmargin at screen (is_tall ? 0.19 : 0.6)
set rmargin at screen (is_tall ? 0.8 : 0.88)
set bmargin at screen (is_tall ? 0.095 : 0.17)
set tmargin at screen (is_tall ? 0.46 : 0.84)
set xlabel label(along_name, unit_t) offset 0,0.3
set ylabel label('height {/:Italic z}', unit_z) offset 0.5,0
set xrange [0:t_end]
set yrange [z_low:z_high]
set xtics steps_of(t_end)
set ytics steps_of(z_high - z_low)
set cbrange [phi_low:phi_high]
set cblabel '{/:Italic φ}' offset 0.3,0
set colorbox noborder user origin screen (is_tall ? 0.83 : 0.905),(is_tall ? 0.14 : 0.25) size screen (is_tall ? 0.02 : 0.012),(is_tall ? 0.28 : 0.5)
eval "set palette defined (" . phi_palette . ")"
set datafile nocolumnheaders
set arrow from 0,z_interface to t_end,z_interface nohead lw 0.8 dt (8,6) lc rgb '#606060' back
plot 'waves.csv' using ($3 <= least_shock ? 0 : NaN):(z_interface):(t_end):1:2 skip 1 with vectors nohead lw 0.6 lc palette, \
  'waves.csv' using ($3 > least_shock ? 0 : NaN):(z_interface):(t_end):1:2 skip 1 with vectors nohead lw 2.6 lc palette
unset multiplot
