# The smallest misfit after so many evaluations; stages minimise different misfits and stand apart.
#
# search.csv   evaluations,misfit,stage   a row whenever the misfit fell, and one at the end of each stage
#
# Variables: those of fit.gp
load 'panel.gp'
left = last_left
right = is_tall ? 0.93 : 0.97
bottom = last_bottom
top = last_top
eval place
least_misfit = 1e-30  # stands for zero
misfit(x) = max(x, least_misfit)
stats 'search.csv' using (column("stage")) nooutput
n_steps = STATS_records
first_stage = int(STATS_min)
last_stage = int(STATS_max)
stats 'search.csv' using (column("evaluations")):(misfit(column("misfit"))) nooutput
end = max(STATS_max_x + 0.5, 2)
first_decade = floor(log10(STATS_min_y))
last_decade = max(ceil(log10(STATS_max_y)), first_decade + 1)

set xlabel 'evaluations' offset 0,0.3
set ylabel 'smallest misfit' offset 0.8,0
set xrange [0:end]
set xtics tic_step(0, end, right - left)
set logscale y
# A little wider, else rounding takes the tics at the ends away.
set yrange [0.999*10.0**first_decade:1.001*10.0**last_decade]
decades = (last_decade - first_decade + 4) / 5
set ytics (sprintf('10^{%d}', first_decade) 10.0**first_decade)
do for [k=first_decade+decades:last_decade:decades] { set ytics add (sprintf('10^{%d}', k) 10.0**k) }
if (decades == 1) do for [k=first_decade:last_decade-1] { do for [m=2:9] { set ytics add ('' m*10.0**k 1) } }
if (last_stage > first_stage) set key on at screen right,top+0.01 right bottom Left reverse samplen 1.8

# Lines where a stage begins, those left out that are close to the one before: with many starts there are many.
set y2range [0:1]
stage = first_stage
drawn = -end
is_new(x, s) = s == stage || x - drawn < 0.04 * end ? (stage = s, NaN) : (stage = s, drawn = x, x)
plot for [i=1:last_stage>first_stage] 'search.csv' using (is_new(column("evaluations") - 0.5, column("stage"))):(0):(0):(1) axes x1y2 \
    with vectors nohead lw 1 dt (4,3) lc rgb '#a8a8a8' title 'new stage', \
  for [s=first_stage:last_stage] 'search.csv' using (column("stage") == s ? column("evaluations") : NaN):(misfit(column("misfit"))) \
    with steps lw 2 lc rgb blue notitle, \
  'search.csv' using "evaluations":(misfit(column("misfit"))) with points pt 7 ps (n_steps > 60 ? 0.15 : 0.35) lc rgb blue notitle
