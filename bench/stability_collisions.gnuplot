# Loose collisions. $gains, named by friction angle and damping: step over the limit, ledger error over
# the energy at the start.
set lmargin at screen 0.13
set rmargin at screen 0.97
set tmargin at screen 0.96
set bmargin at screen 0.16
set logscale y
set format y '10^{%T}'
set xrange [0.05:0.85]
set yrange [1e-5:1e4]
set xtics 0.1,0.1
set xlabel 'Step over the limit 2/ω_{max} (-)'
set ylabel 'Ledger error over the energy at the start (-)'
set key top left Left reverse
plot $gains index '[0-0]' using 1:2 with linespoints pt 7 ps 1.5 lw 2 lc rgb contrast title 'no friction, undamped', \
     $gains index '[0.6-0]' using 1:2 with linespoints pt 6 ps 1.5 lw 2 lc rgb contrast title 'friction, undamped', \
     $gains index '[0-0.2]' using 1:2 with linespoints pt 5 ps 1.3 lw 2 lc rgb main title 'no friction, damping 0.2', \
     $gains index '[0.6-0.2]' using 1:2 with linespoints pt 4 ps 1.3 lw 2 lc rgb main title 'friction, damping 0.2'
