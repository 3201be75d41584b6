# Overlaps at the start. $bursts, named by kernels and safety: overlap [%], ledger error over elastic
# energy, largest speed [m/s].
set multiplot
set logscale xy
set format y '10^{%T}'
set xrange [0.08:6.5]
set xtics ('0.1' 0.1, '0.2' 0.2, '0.5' 0.5, '1' 1, '2' 2, '5' 5)
set xlabel 'Overlap at the start (% of the radius)'
set tmargin at screen 0.95
set bmargin at screen 0.15

set lmargin at screen 0.085
set rmargin at screen 0.475
set yrange [1e-4:100]
set ylabel 'Ledger error over elastic energy (-)' offset 0.5,0
set key top right Left reverse
plot $bursts index '[reference-0.8]' using 1:2 with linespoints pt 6 ps 2.4 lw 2 lc rgb soft title 'reference, safety 0.8', \
     $bursts index '[double-0.8]' using 1:2 with linespoints pt 7 ps 1.2 lw 1.5 lc rgb main title 'double', \
     $bursts index '[mixed-0.8]' using 1:2 with linespoints pt 5 ps 0.9 lw 1.5 dt 2 lc rgb contrast title 'mixed', \
     $bursts index '[reference-0.2]' using 1:2 with linespoints pt 8 ps 2.4 lw 2 lc rgb soft title 'reference, safety 0.2', \
     $bursts index '[double-0.2]' using 1:2 with linespoints pt 9 ps 1.2 lw 1.5 lc rgb main title 'double', \
     $bursts index '[mixed-0.2]' using 1:2 with linespoints pt 13 ps 0.9 lw 1.5 dt 2 lc rgb contrast title 'mixed'

set lmargin at screen 0.585
set rmargin at screen 0.975
set yrange [1:1000]
set ylabel 'Largest speed of a sphere (m/s)'
set key top left
plot $bursts index '[reference-0.8]' using 1:3 with linespoints pt 6 ps 2.4 lw 2 lc rgb soft title 'reference', \
     $bursts index '[double-0.8]' using 1:3 with linespoints pt 7 ps 1.2 lw 1.5 lc rgb main title 'double', \
     $bursts index '[mixed-0.8]' using 1:3 with linespoints pt 5 ps 0.9 lw 1.5 dt 2 lc rgb contrast title 'mixed'
unset multiplot
