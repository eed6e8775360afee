# phi over time and height, in colours, with contours at round values.
#
# map.csv     t,z,phi,smooth   the same heights at every time, with an empty line between times; smooth: phi, or NaN where it
#             is too steep for contours
# labels.csv  t,z,label   states of contours, where there is room for them
# shocks.csv  layer,t_begin,z_begin,t_end,z_end,phi_below,phi_above   as written by `shearfront solve --fronts`
#
# Variables: t_end               right end of the axis
#            z_low, z_high       bottom and top
#            phi_low, phi_high   states of the bed
#            interfaces          their heights, words
#            contours            states of the contours, words
#            has_labels, has_shocks   1 if these files have rows
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
if (!exists("contours")) contours = ''
if (!exists("has_labels")) has_labels = 1
if (!exists("has_shocks")) has_shocks = 1
# Words with commas between them. Not called join: gnuplot 6 has one of that name.
with_commas(names) = words(names) < 2 ? names : word(names, 1) . ', ' . with_commas(names[strlen(word(names, 1))+2:*])

# Contours first, into a block of their own: they are drawn on top of the colours.
set contour base
eval "set cntrparam levels discrete " . (contours eq '' ? '1e300' : with_commas(contours))
unset surface
set datafile missing 'NaN'
set table $contours
splot 'map.csv' using "t":"z":"smooth"
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
set cbtics round_up((phi_high - phi_low) / (is_narrow ? 5.0 : 10.0))
set xtics steps_of(t_end)
set ytics steps_of(z_high - z_low)
if (!exists("interfaces")) interfaces = ''
do for [z in interfaces] { set arrow from 0,real(z) to t_end,real(z) nohead lw 0.7 dt (8,6) lc rgb '#80ffffff' front }
set border 3 lw 0.8 front
set tics front
eval "set palette defined (" . phi_palette . ")"
set datafile nocolumnheaders
column_of_line(i) = real(word(strcol(1), i))  # contours come with blanks between numbers
end(text) = text eq '' ? t_end : real(text)  # a shock that never ends
plot 'map.csv' using 1:2:3 skip 1 with image, \
  $contours using (column_of_line(1)):(column_of_line(2)) with lines lw 0.6 lc rgb '#60ffffff', \
  for [i=1:has_shocks] 'shocks.csv' using 2:3:(end(strcol(4)) - $2):($5 - $3) skip 1 with vectors nohead lw 1.6 lc rgb 'white', \
  for [i=1:has_labels] 'labels.csv' using 1:2:3 skip 1 with labels font sprintf(',%.2f', 0.72 * letters) tc rgb 'white'
