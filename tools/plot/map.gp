# phi over time and height, in colours, with contours at round values.
#
# map.csv   t,z,phi   the same heights at every time, with an empty line between times; from the output of
#           `shearfront solve -o`:  awk -F, 'NR > 2 && $1 != t { print "" } { t = $1; print }' out.csv > map.csv
#
# Variables: t_end               right end of the axis
#            z_low, z_high       bottom and top
#            phi_low, phi_high   states of the bed
width = 560
height = 440
load 'style.gp'
if (!exists("t_end")) {
  stats 'map.csv' using (column("t")) nooutput
  t_end = STATS_max
}
if (!exists("z_low")) z_low = 0
if (!exists("z_high")) z_high = 1
if (!exists("phi_low")) phi_low = 0
if (!exists("phi_high")) phi_high = 1

# Contours first, into a block of their own: they are drawn on top of the colours. Those of both ends are noise.
step = round_up((phi_high - phi_low) / 12.0)
set contour base
set cntrparam levels incremental step*ceil(phi_low/step+0.001),step,phi_high-step/1000
unset surface
set table $contours
splot 'map.csv' using "t":"z":"phi"
unset table
unset contour
set surface

set title title noenhanced offset 0,0.2
set xlabel label(along_name, unit_t) offset 0,0.3
set ylabel label('height {/:Italic z}', unit_z) offset 0,0
set xrange [0:t_end]
set yrange [z_low:z_high]
set cbrange [phi_low:phi_high]
set cblabel 'concentration {/:Italic φ}' offset 0.8,0
set colorbox noborder
set cbtics is_narrow ? 2*step : step
set xtics steps_of(t_end)
set ytics steps_of(z_high - z_low)
subtitle = subtitle . (subtitle eq '' ? '' : ', ') . sprintf('contours every %g', step)
eval set_subtitle
set border 3 lw 0.8 front
set tics front
eval "set palette defined (" . phi_palette . ")"
set datafile nocolumnheaders
column_of_line(i) = real(word(strcol(1), i))  # contours come with blanks between numbers
plot 'map.csv' using 1:2:3 with image, \
  $contours using (column_of_line(1)):(column_of_line(2)) with lines lw 0.6 lc rgb '#60ffffff'
