# Fronts in the (t, z) plane: fans coloured by phi, shocks thicker and darker the larger their jump, pure regions tinted,
# interfaces dashed, event times marked.
#
# fronts.csv   layer,t_begin,z_begin,t_end,z_end,phi_below,phi_above   as written by `shearfront solve --fronts`
# pure.csv     t,z,kind   a grid: kind 1 where there are small grains only, -1 large ones only
# events.csv   t,z,label,side,is_first   marked points; side: where the label stands (see the last lines); is_first: the first wave
#              at one of many interfaces
#
# Variables: t_end               right end of the axis
#            z_low, z_high       bottom and top
#            phi_low, phi_high   range of the colours
#            interfaces          their heights, words
#            wall_low, wall_high 1 for a wall at the bottom, at the top
#            least_shock         jumps up to this are drawn like fronts of a fan
#            fan_width           width of these lines
#            has_pure            1 if there is pure.csv
#            n_listed            interfaces whose events are named in the legend: too many for labels; 0: labels
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
if (!exists("has_pure")) has_pure = 0
if (!exists("n_listed")) n_listed = 0
if (!exists("along")) along = 't'

n_widths = 12
widest = 3.6
width_of(i) = fan_width + (widest - fan_width) * i / (n_widths - 1.0)
share(jump) = jump <= least_shock ? 0 : (jump - least_shock) / (phi_high - phi_low - least_shock)
shade(i) = int(150 - 150 * i / (n_widths - 1.0))
grey_of(i) = sprintf('#%02x%02x%02x', shade(i), shade(i), shade(i))
class(below, above) = min(n_widths - 1, floor(n_widths * share(abs(below - above))))
end(text) = text eq '' ? t_end : real(text)  # a front that never ends

set title title noenhanced offset 0,0.9
set lmargin 5.5 + max(3, strlen(sprintf('%.4g', z_high)))
set rmargin is_narrow ? 11 : 14
set bmargin is_narrow ? 4.4 : 5
set tmargin 3.4 + 0.9 * (strlen(title) > longest_line ? ceil(1.1 * strlen(title) / longest_line) - 1 : 0)
set xlabel label(along_name, unit_t) offset 0,-0.2
set ylabel label('height {/:Italic z}', unit_z) offset 0.3,0
set xrange [0:t_end]
set yrange [z_low:z_high]
set xtics steps_of(t_end) offset 0,-0.7
set ytics steps_of(z_high - z_low)
set clip two
set cbrange [phi_low:phi_high]
set cblabel is_narrow ? '{/:Italic φ}' : '{/:Italic φ}, mean of both sides' offset 0.3,0
if (phi_low == 0 && phi_high == 1) { set cbtics 0.25 } else { set cbtics round_up((phi_high - phi_low) / (is_narrow ? 4.0 : 8.0)) }
set colorbox noborder user origin graph 1.045,0.4 size graph 0.025,0.55
# Shocks: a line for each of three jumps, below the colours.
key_font = sprintf(',%.2f', 0.8 * letters)
set key at graph 1.03,0.3 left top vertical Left reverse samplen 1.1 spacing 1.05 width -2 font key_font
jump_of(k) = phi_width * word('1 0.5 0.25', k)
phi_width = phi_high - phi_low
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
listed(hat) = sprintf('{/:Italic %s%s}_{c}(1)–(%d)', along, hat, n_listed)
tint(kind, channel) = kind > 0 ? word('255 243 222', channel) + 0 : kind < 0 ? word('232 230 246', channel) + 0 : 255
plot for [i=1:has_pure] 'pure.csv' using 1:2:(tint($3, 1)):(tint($3, 2)):(tint($3, 3)) with rgbimage notitle, \
  'fronts.csv' using (class($6, $7) == 0 ? $2 : NaN):3:(end(strcol(4)) - $2):($5 - $3):(($6 + $7) / 2) \
    with vectors nohead lw fan_width lc palette notitle, \
  for [i=1:n_widths-1] $shocks using ($6 == i ? $1 : NaN):2:3:4 with vectors nohead lw width_of(i) lc rgb grey_of(i) notitle, \
  for [k=1:3] keyentry with lines lw width_of(class(0, jump_of(k))) lc rgb grey_of(class(0, jump_of(k))) title sprintf('jump %.3g', jump_of(k)), \
  'events.csv' using "t":"z" with points pt 7 ps 0.75 lc rgb 'white' notitle, \
  'events.csv' using "t":"z" with points pt 7 ps 0.55 lc rgb 'black' notitle, \
  'events.csv' using "t":(column("is_first") == 1 ? column("z") : NaN) with points pt 7 ps 0.33 lc rgb 'white' notitle, \
  for [i=1:n_listed>0] keyentry with points pt 6 ps 0.55 lw 1.3 lc rgb 'black' title listed(''), \
  for [i=1:n_listed>0] keyentry with points pt 7 ps 0.55 lc rgb 'black' title listed('̂'), \
  for [i=1:has("left-above")] 'events.csv' using "t":(at("left-above")):"label" with labels right offset -0.6,0.75 notitle, \
  for [i=1:has("left-below")] 'events.csv' using "t":(at("left-below")):"label" with labels right offset -0.6,-0.75 notitle, \
  for [i=1:has("right-above")] 'events.csv' using "t":(at("right-above")):"label" with labels left offset 0.7,0.75 notitle, \
  for [i=1:has("right-below")] 'events.csv' using "t":(at("right-below")):"label" with labels left offset 0.7,-0.75 notitle, \
  for [i=1:has("right")] 'events.csv' using "t":(at("right")):"label" with labels left offset 0.9,0 notitle, \
  for [i=1:has("below")] 'events.csv' using "t":(at("below")):"label" with labels center offset 0,-0.85 notitle, \
  for [i=1:has("above")] 'events.csv' using "t":(at("above")):"label" with labels center offset 0,0.8 notitle, \
  NaN notitle  # for a bed without fronts
