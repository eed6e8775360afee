# What one more measurement is worth over time and height, and which were chosen.
#
# design.csv   t,z,[width,]weight,worth,chosen   as written by `shearfront design -o`
#
# Variables: z_low, z_high   bottom and top
width = 560
height = 440
load 'style.gp'
if (!exists("z_low")) z_low = 0
if (!exists("z_high")) z_high = 1

stats 'design.csv' using (column("t")) nooutput name 'T'
stats 'design.csv' using (column("worth")) nooutput name 'W'
set title title noenhanced offset 0,0.2
set xlabel label(along_name, unit_t) offset 0,0.3
set ylabel label('height {/:Italic z}', unit_z) offset 0,0
margin = T_max > T_min ? 0.02 * (T_max - T_min) : 0.05 * (T_max + (T_max == 0))
set xrange [T_min-margin:T_max+margin]
set yrange [z_low:z_high]
set cbrange [0:1]
set cblabel is_narrow ? 'worth of one more' : 'worth of one more, part of the largest' offset 0.8,0
set colorbox noborder
set xtics steps_of(T_max)
set ytics steps_of(z_high - z_low)
eval set_subtitle
set border 3 lw 0.8 front
set tics front
set palette defined (0 '#f7f7f7', 0.15 '#c6dbef', 0.5 '#6baed6', 1 '#08306b')
unset key
plot 'design.csv' using "t":"z":(column("worth")/W_max) with points pt 5 ps 0.6 palette, \
  '' using "t":(column("chosen") == 1 ? column("z") : NaN) with points pt 6 ps 1.1 lw 1.4 lc rgb '#d62728'
