# Values of the cells. $bins: middle, density, width, predicted density, its band; $predicted: value,
# density.
set xrange [low:high]
set yrange [0:*]
set xlabel quantity offset 0,0.3
set ylabel 'Probability density (1/'.unit.')' offset 0.5,0
set style fill solid 0.5 border lc rgb '#ffffff'
load 'legend_above.gnuplot'
plot $bins using 1:2:3 with boxes lc rgb soft title 'cells', \
     $predicted using 1:2 with lines lw 1.8 lc rgb contrast title 'predicted', \
     $bins using 1:4:($1-0.22*$3):($1+0.22*$3):5:6 with boxxyerror fs transparent solid 0.4 noborder lc rgb ink title sprintf('%d %% band', band)
