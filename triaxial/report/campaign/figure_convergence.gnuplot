# Running mean and deviation. $runs: realizations, mean, its interval, deviation, its interval.
load 'legend_above.gnuplot'
set multiplot layout 1,2
set xrange [0:last]
set xtics step
set xlabel 'Number of realizations' offset 0,0.3
set style fill solid 0.25 noborder
set yrange [low:high]
set ylabel 'Mean of '.symbol.' ('.unit.')' offset 0.5,0
plot $runs using 1:3:4 with filledcurves lc rgb soft title '95 % interval', \
     $runs using 1:2 with linespoints lw 1.8 pt 7 ps dots lc rgb main title 'mean', \
     for [k=1:has_deterministic] deterministic with lines lw 1.2 dt 2 lc rgb contrast title 'deterministic'
set yrange [0:most]
set ylabel 'Standard deviation of '.symbol.' ('.unit.')' offset 0.5,0
plot $runs using 1:6:7 with filledcurves lc rgb soft title '95 % interval', \
     $runs using 1:5 with linespoints lw 1.8 pt 7 ps dots lc rgb main title 'standard deviation'
unset multiplot
