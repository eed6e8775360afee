# Observed and fitted heights of the bed against time.
#
# residuals.csv   t,z,observed,predicted,residual[,sigma]   as written by `shearfront fit -o`
# fitted.csv      t,H   of the estimate, as written by `shearfront solve --quantity bed-height`
#
# Variables: those of fit.gp
load 'panel.gp'
left = is_tall ? 0.19 : 0.13
right = is_tall ? 0.73 : 0.82
bottom = data_bottom
top = data_top
eval place
stats 'residuals.csv' using (column("t")) nooutput
n_points = STATS_records
t_end = STATS_max > 0 ? STATS_max : 1
has_bars = has_sigma && n_points <= 60  # more of them hide the points
set xlabel label(along_name, unit_t) offset 0,0.3
set ylabel label('height of the bed {/:Italic H}', unit_value) offset 0.5,0
set xrange [0:t_end]
set xtics tic_step(0, t_end, right - left)
set offsets 0,0,graph 0.03,graph 0.03
set key at screen right+0.02,0.5*(top+bottom) left center vertical Left reverse samplen 1.6 spacing 1.25
size = n_points > 50 ? 0.3 : 0.45
plot for [i=1:has_bars] 'residuals.csv' using "t":"observed":(1.96*column("sigma")) with yerrorbars pt 6 ps size lc rgb dark_grey title 'observed (95 %)', \
  for [i=1:!has_bars] 'residuals.csv' using "t":"observed" with points pt 6 ps size lc rgb dark_grey title 'observed', \
  'fitted.csv' using "t":"H" with lines lw 2 lc rgb blue title 'fitted'
