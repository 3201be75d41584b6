# Variance of every cell over the exact one. $cells: number, ratio, 1 outside of the band of all.
set xlabel 'Cell' offset 0,0.3
set ylabel 'Variance over exact (-)' offset 1,0
set xrange [0:last]
load 'legend_above.gnuplot'
plot low with lines lw 1.6 lc rgb ink title sprintf('%d %% band of all', band), \
     high with lines lw 1.6 lc rgb ink notitle, \
     single_low with lines dt 2 lc rgb muted title '95 % of one', \
     single_high with lines dt 2 lc rgb muted notitle, \
     $cells using 1:($3 == 0 ? $2 : 1/0) with points pt 7 ps 0.35 lc rgb main title 'cells', \
     $cells using 1:($3 == 1 ? $2 : 1/0) with points pt 7 ps 0.6 lc rgb contrast notitle
