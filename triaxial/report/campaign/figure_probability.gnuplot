# P-P plot. $points: share of the values below, fitted, the band of each point; `band`: half the width
# of the band of all.
set xrange [0:1]
set yrange [0:1]
set size square
set xlabel 'Share of the values below' offset 0,0.3
set ylabel 'Fitted '.family offset 0.5,0
set style fill solid 0.25 noborder
load 'legend_above.gnuplot'
set key maxrows 2
plot $points using 1:3:4 with filledcurves lc rgb soft title '95 % of each point', \
     x+band with lines lw 1 dt 3 lc rgb muted title '95 % of all points', \
     x-band with lines lw 1 dt 3 lc rgb muted notitle, \
     x with lines lw 1 lc rgb muted notitle, \
     $points using 1:2 with points pt 7 ps 0.35 lc rgb main title 'realizations'
