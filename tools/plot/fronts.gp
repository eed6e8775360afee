# Fronts in the (t, z) plane: coloured by phi, shocks thicker the larger they are, interfaces dashed, event times marked.
#
# fronts.csv   layer,t_begin,z_begin,t_end,z_end,phi_below,phi_above   as written by `shearfront solve --fronts`
# events.csv   t,z,label,side   marked points; side: where the label stands (see the last lines)
#
# Variables: t_end               right end of the axis
#            z_low, z_high       bottom and top
#            phi_low, phi_high   range of the colours
#            interfaces          their heights, words
#            wall_low, wall_high 1 for a wall at the bottom, at the top
#            least_shock         jumps up to this are drawn like fronts of a fan
#            fan_width           width of these lines
width = 640
height = 440
is_subtitle_below = 1  # labels of events stand above the axes
load 'style.gp'
if (!exists("t_end")) {
  stats 'fronts.csv' using (column("t_end")) nooutput
  t_end = STATS_max
}
if (!exists("z_low")) z_low = 0
if (!exists("z_high")) z_high = 1
if (!exists("phi_low")) phi_low = 0
if (!exists("phi_high")) phi_high = 1
if (!exists("interfaces")) interfaces = ''
if (!exists("wall_low")) wall_low = 1
if (!exists("wall_high")) wall_high = 1
if (!exists("least_shock")) least_shock = 0.015
if (!exists("fan_width")) fan_width = 0.7

n_widths = 12
widest = 3.6
width_of(i) = fan_width + (widest - fan_width) * i / (n_widths - 1.0)
share(jump) = jump <= least_shock ? 0 : (jump - least_shock) / (1 - least_shock)
class(below, above) = min(n_widths - 1, floor(n_widths * share(abs(below - above))))
end(text) = text eq '' ? t_end : real(text)  # a front that never ends

set title title noenhanced offset 0,0.9
set lmargin 5.5 + max(3, strlen(sprintf('%.4g', z_high)))
set rmargin 14
set bmargin 5
set tmargin 4 + 0.9 * (strlen(title) > longest_line ? ceil(1.1 * strlen(title) / longest_line) - 1 : 0)
set xlabel label(along_name, unit_t) offset 0,-0.2
set ylabel label('height {/:Italic z}', unit_z) offset 0.3,0
set xrange [0:t_end]
set yrange [z_low:z_high]
set xtics steps_of(t_end) offset 0,-0.7
set ytics steps_of(z_high - z_low)
set clip two
set cbrange [phi_low:phi_high]
set cblabel is_narrow ? '{/:Italic φ}' : '{/:Italic φ}, mean of both sides' offset 0.3,0
if (phi_low == 0 && phi_high == 1) set cbtics 0.25
set colorbox noborder user origin graph 1.045,0.15 size graph 0.025,0.7
eval "set palette defined (" . phi_palette . ")"
if (wall_low) set arrow from 0,z_low to t_end,z_low nohead lw 2.5 lc rgb 'black' front
if (wall_high) set arrow from 0,z_high to t_end,z_high nohead lw 2.5 lc rgb 'black' front
do for [z in interfaces] { set arrow from 0,real(z) to t_end,real(z) nohead lw 0.8 dt (8,6) lc rgb '#606060' front }

# Labels where there are any: gnuplot 5.4 crashes on a plot of labels all of which are left out.
sides = ''
note(side) = (sides = sides . ' ' . side . ' ', 0)
stats 'events.csv' using (note(strcol("side"))) nooutput
at(where) = strcol("side") eq where ? column("z") : NaN
has(where) = strstrt(sides, ' '.where.' ') > 0

# Shocks apart, so that the many fronts of fans are read only twice.
set print $shocks
print "t,z,dt,dz,phi,class"
unset print
set table $shocks append separator comma
plot 'fronts.csv' using 2:3:(end(strcol(4)) - $2):($5 - $3):(($6 + $7) / 2):(class($6, $7)) with table if (class($6, $7) > 0)
unset table
plot 'fronts.csv' using (class($6, $7) == 0 ? $2 : NaN):3:(end(strcol(4)) - $2):($5 - $3):(($6 + $7) / 2) \
    with vectors nohead lw fan_width lc palette, \
  for [i=1:n_widths-1] $shocks using ($6 == i ? $1 : NaN):2:3:4:5 with vectors nohead lw width_of(i) lc palette, \
  'events.csv' using "t":"z" with points pt 7 ps 0.75 lc rgb 'white', \
  'events.csv' using "t":"z" with points pt 7 ps 0.55 lc rgb 'black', \
  for [i=1:has("left-above")] 'events.csv' using "t":(at("left-above")):"label" with labels right offset -0.6,0.75, \
  for [i=1:has("left-below")] 'events.csv' using "t":(at("left-below")):"label" with labels right offset -0.6,-0.75, \
  for [i=1:has("right-above")] 'events.csv' using "t":(at("right-above")):"label" with labels left offset 0.7,0.75, \
  for [i=1:has("right-below")] 'events.csv' using "t":(at("right-below")):"label" with labels left offset 0.7,-0.75, \
  for [i=1:has("right")] 'events.csv' using "t":(at("right")):"label" with labels left offset 0.9,0, \
  for [i=1:has("below")] 'events.csv' using "t":(at("below")):"label" with labels center offset 0,-0.85, \
  for [i=1:has("above")] 'events.csv' using "t":(at("above")):"label" with labels center offset 0,0.8, \
  NaN  # for a bed without fronts
