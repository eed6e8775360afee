# phi of a slab over x and z, in colours: a panel per time.
#
# slab.csv   x,z,phi   a block of all places per time, blocks apart by two empty lines
#
# Variables: times               words, in the order of the blocks
#            x_high              length of the slab
#            z_low, z_high       bottom and top
#            phi_low, phi_high   states of the slab
if (!exists("times")) times = '0'
if (!exists("x_high")) x_high = 1
if (!exists("z_low")) z_low = 0
if (!exists("z_high")) z_high = 1
if (!exists("phi_low")) phi_low = 0
if (!exists("phi_high")) phi_high = 1

n_times = words(times)
is_tall = exists("width_cm") && !exists("height_cm") && width_cm < 13  # a column of a page
n_columns = is_tall && n_times > 1 ? 2 : n_times < 4 ? n_times : n_times == 4 ? 2 : n_times < 7 ? 3 : 4
n_rows = (n_times + n_columns - 1) / n_columns
left_space = 66
right_space = 104
title_height = 34
bottom_space = 44
panel_width = is_tall ? (n_columns == 1 ? 260 : 130) : 190
panel_height = is_tall && n_columns == 2 ? 140 : 180
width = left_space + n_columns * panel_width + right_space
height = title_height + n_rows * panel_height + bottom_space
is_panels = 1
is_subtitle_below = is_tall
load 'style.gp'
full_width = 1.0 * (left_space + n_columns * panel_width + right_space)
full_height = 1.0 * (title_height + n_rows * panel_height + bottom_space)

set multiplot
do for [k=1:n_times] {
  load 'panel.gp'
  i_column = (k - 1) % n_columns
  i_row = (k - 1) / n_columns
  is_lowest = k + n_columns > n_times
  if (k == 1) {
    set label 1 title noenhanced at screen 0.5,1-0.4*title_height/full_height center font sprintf(',%.2f', 1.15*letters)
    eval set_subtitle
  }
  set lmargin at screen (left_space + i_column * panel_width) / full_width
  set rmargin at screen (left_space + (i_column + 1) * panel_width - 22) / full_width
  set tmargin at screen 1 - (title_height + i_row * panel_height + 20) / full_height
  set bmargin at screen 1 - (title_height + (i_row + 1) * panel_height - 14) / full_height
  set title sprintf('{/:Italic t} = %.5g', real(word(times, k))) . (unit_t eq '' ? '' : ' ' . unit_t) offset 0,-0.7
  set xrange [0:x_high]
  set yrange [z_low:z_high]
  set xtics round_up(x_high / 3.0)
  set ytics round_up((z_high - z_low) / 5.0)
  if (is_lowest) { set xlabel label('{/:Italic x}', unit_z) offset 0,0.5 } else { set format x '' }
  if (i_column == 0) { set ylabel label('height {/:Italic z}', unit_z) offset 0.8,0 } else { set format y '' }
  set cbrange [phi_low:phi_high]
  eval "set palette defined (" . phi_palette . ")"
  if (k == n_times) {
    set colorbox noborder user origin screen 1-(right_space-18)/full_width,0.5-0.5*(panel_height-34)/full_height size screen 14/full_width,(panel_height-34)/full_height
    set cblabel 'concentration {/:Italic φ}' offset 0.5,0
  } else { unset colorbox }
  set border 3 lw 0.8 front
  set tics front
  plot 'slab.csv' using 1:2:3 index k-1 with image
  unset label 1
}
unset multiplot
