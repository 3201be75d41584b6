# Strain rates. $runs: rate [1/s], peak [kPa], E50 [MPa], error of the lateral stress, RMS and largest
# [%], unbalanced force ratio, kinetic over elastic energy, inertial number; $means: rate, mean and
# deviation of the peak and of E50.
set multiplot
set logscale x
set xrange [0.007:1.4]
set xtics ('0.01' 0.01, '0.03' 0.03, '0.1' 0.1, '0.3' 0.3, '1' 1)
set xlabel 'Strain rate (1/s)' offset 0,0.3
set key bottom right Left reverse

set lmargin at screen 0.095
set rmargin at screen 0.48
set tmargin at screen 0.97
set bmargin at screen 0.60
set yrange [0:*]
set ylabel 'Peak of q (kPa)' offset 0.5,0
plot $runs using 1:2 with points pt 6 ps 1.3 lw 1.2 lc rgb soft title 'runs', \
     $means using 1:2:3 with yerrorbars pt 7 ps 1.1 lw 1.8 lc rgb main title 'mean ± deviation'

set lmargin at screen 0.59
set rmargin at screen 0.98
set ylabel 'E_{50} (MPa)'
plot $runs using 1:3 with points pt 6 ps 1.3 lw 1.2 lc rgb soft title 'runs', \
     $means using 1:4:5 with yerrorbars pt 7 ps 1.1 lw 1.8 lc rgb main title 'mean ± deviation'

set logscale y
set key top left Left reverse
set lmargin at screen 0.095
set rmargin at screen 0.48
set tmargin at screen 0.48
set bmargin at screen 0.11
set yrange [0.005:200]
set ytics ('0.01' 0.01, '0.1' 0.1, '1' 1, '10' 10, '100' 100)
set ylabel 'Error of the lateral stress (%)' offset 0.5,0
set arrow 1 from graph 0,first 0.5 to graph 1,first 0.5 nohead lw 1 dt 3 lc rgb main back
set arrow 2 from graph 0,first 1 to graph 1,first 1 nohead lw 1 dt 3 lc rgb contrast back
plot $runs using 1:4 with points pt 7 ps 1.2 lc rgb main title 'RMS; allowed 0.5', \
     $runs using 1:5 with points pt 5 ps 1.1 lc rgb contrast title 'largest; allowed 1'
unset arrow 1
unset arrow 2

set lmargin at screen 0.59
set rmargin at screen 0.98
set yrange [1e-5:1000]
set ytics autofreq
set format y '10^{%T}'
set ylabel 'Share (-)'
plot $runs using 1:6 with points pt 7 ps 1.2 lc rgb main title 'mean unbalanced force ratio', \
     $runs using 1:7 with points pt 5 ps 1.1 lc rgb contrast title 'kinetic over elastic energy, end', \
     $runs using 1:8 with points pt 8 ps 1.4 lw 1.5 lc rgb ink title 'inertial number'
unset multiplot
