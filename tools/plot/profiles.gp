# Profiles phi(z) at some times, z upwards.
#
# profiles.csv   t,z,phi,M   as written by `shearfront solve -o`: the same heights at every time
# exact.csv      the same by the exact method, drawn as thin lines on top, unless there are too many times for a legend
# bound.csv      z,c   the solid fraction, which phi cannot exceed, drawn dashed
# other1.csv, other2.csv, ...   the same by other methods, dashed
#
# Variables: others              their names, words
#            times               words, in the order of the file
#            has_exact           1 if there is exact.csv
#            has_bound           1 if there is bound.csv
#            z_low, z_high       bottom and top
#            phi_low, phi_high   states of the bed
#            interfaces          their heights, words
#            symbol              what stands before phi on the axis
width = 560
height = 480
title_share = 0.73  # the legend stands beside the axes
load 'style.gp'
if (!exists("times")) {  # one profile, of unknown time
  times = 'unknown'
}
if (!exists("has_exact")) has_exact = 0
if (!exists("has_bound")) has_bound = 0
if (!exists("others")) others = ''
if (!exists("z_low")) z_low = 0
if (!exists("z_high")) z_high = 1
if (!exists("phi_low")) phi_low = 0
if (!exists("phi_high")) phi_high = 1
if (!exists("interfaces")) interfaces = ''
if (!exists("symbol")) symbol = ''

set title title noenhanced offset 0,0.2
set xlabel 'concentration '.symbol.'{/:Italic φ}' offset 0,0.3
set ylabel label('height {/:Italic z}', unit_z) offset 0,0
margin = 0.02 * (phi_high - phi_low)
set xrange [phi_low-margin:phi_high+margin]
set yrange [z_low:z_high]
if (phi_low == 0 && phi_high == 1) set xtics 0.2
if (is_narrow) {
  key_font = sprintf(',%.2f', 0.9 * letters)
  n_keys = words(times) + words(others) + has_exact + has_bound
  n_key_columns = n_keys > 6 && words(others) == 0 ? 3 : 2
  n_key_rows = words(times) > words(many_colours) ? has_bound > 0 : (n_keys + n_key_columns - 1) / n_key_columns
  set bmargin 3.8 + 1.15 * n_key_rows
  set key at screen 0.5,0.012 center bottom horizontal Left reverse samplen 1.2 spacing 1.1 maxcols n_key_columns font key_font
} else {
  set key outside right center Left reverse samplen 1.6 spacing 1.25 width -1
}
set ytics steps_of(z_high - z_low)
do for [z in interfaces] { set arrow from graph 0,first real(z) to graph 1,first real(z) nohead lw 0.8 dt (8,6) lc rgb grey back }

n_times = words(times)
stats 'profiles.csv' using (column("z")) nooutput
n = STATS_records / n_times
t_of(i) = real(word(times, i))
line_width = has_exact ? 2.4 : 2.0
exact = has_exact ? 'exact.csv' : 'profiles.csv'
n_others = words(others)
other(j) = n_others == 0 ? 'profiles.csv' : sprintf('other%d.csv', j)
dash_of(j) = 2 + j % 4
dark_of(k) = 'black'
unit = unit_t eq '' ? '' : ' ' . unit_t
dash(i) = t_of(i) == 0 ? 2 : 1  # the start is seen between lines on top of it
if (n_times <= words(many_colours)) {
  # The first on top, the legend in the order of the file.
  plot for [k=1:n_times] 'profiles.csv' using "phi":"z" every ::((n_times-k)*n)::((n_times-k+1)*n-1) \
      with lines lw line_width dt dash(n_times-k+1) lc rgb word(many_colours, n_times-k+1) notitle, \
    for [i=1:has_exact*n_times] exact using "phi":"z" every ::((i-1)*n)::(i*n-1) \
      with lines lw 0.8 lc rgb 'black' notitle, \
    for [j=1:n_others] for [k=1:n_times] other(j) using "phi":"z" every ::((k-1)*n)::(k*n-1) \
      with lines lw 1.3 dt dash_of(j) lc rgb dark_of(k) notitle, \
    for [i=1:n_times] keyentry with lines lw line_width dt dash(i) lc rgb word(many_colours, i) title sprintf('{/:Italic '.along.'} = %.5g', t_of(i)).unit, \
    for [i=1:has_exact] keyentry with lines lw 0.8 lc rgb 'black' title 'exact', \
    for [i=1:has_bound] 'bound.csv' using "c":"z" with lines lw 1.2 dt (10,6) lc rgb dark_grey title 'bound {/:Italic c}({/:Italic z})', \
    for [j=1:n_others] keyentry with lines lw 1.3 dt dash_of(j) lc rgb 'black' title word(others, j)
} else {  # too many to be named
  eval "set palette defined (" . phi_palette . ")"
  first = t_of(1)
  last = t_of(1)
  do for [t in times] {
    first = min(first, real(t))
    last = max(last, real(t))
  }
  set cbrange [first:last > first ? last : first + 1]
  set cblabel label(along_name, unit_t) offset 1.2,0
  set colorbox noborder
  plot for [k=1:n_times] 'profiles.csv' using "phi":"z" every ::((n_times-k)*n)::((n_times-k+1)*n-1) \
      with lines lw line_width dt dash(n_times-k+1) lc palette cb t_of(n_times-k+1) notitle, \
    for [i=1:has_bound] 'bound.csv' using "c":"z" with lines lw 1.2 dt (10,6) lc rgb dark_grey title 'bound {/:Italic c}({/:Italic z})'
}
