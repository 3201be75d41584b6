# Where the work of the walls went. $energies: time [s], work put in, dissipated by friction and by
# damping, elastic, kinetic [J].
set lmargin at screen 0.075
set rmargin at screen 0.985
set tmargin at screen 0.95
set bmargin at screen 0.17
set xrange [0:last]
set yrange [0:*]
set xlabel 'Time (s)' offset 0,0.3
set ylabel 'Energy (J)' offset 0.5,0
set key at graph 0.5,graph 0.97
set arrow 1 from began,graph 0 to began,graph 1 nohead lw 1 dt (3,3) lc rgb muted
set label 1 'shear begins' at began,graph 0.93 left offset 0.6,0 tc rgb muted
plot $energies using 1:2 with lines lw 2.4 lc rgb ink title 'put in by the walls', \
     $energies using 1:3 with lines lw 2 lc rgb contrast title 'dissipated by friction', \
     $energies using 1:4 with lines lw 2 lc rgb main title 'dissipated by damping', \
     $energies using 1:5 with lines lw 2 lc rgb soft title 'elastic', \
     $energies using 1:6 with lines lw 1.4 dt (6,4) lc rgb muted title 'kinetic'
