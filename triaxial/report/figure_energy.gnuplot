# Where the work of the walls went. $energies: time [s], work put in, dissipated by friction and by
# damping, elastic, kinetic [J]; `began`: when shear began [s], NaN where nobody knows.
load 'legend_above.gnuplot'
set key width -6
set xrange [0:last]
set yrange [0:*]
set xlabel 'Time (s)' offset 0,0.3
set ylabel 'Energy (J)' offset 0.5,0
if (began == began) {
    set arrow 1 from began,graph 0 to began,graph 1 nohead lw 1 dt (3,3) lc rgb muted
    set x2range [0:last]
    set x2tics ('shear begins' began) scale 0 textcolor rgb muted offset 0,-0.4
}
plot $energies using 1:2 with lines lw 2.4 lc rgb ink title 'put in by the walls', \
     $energies using 1:3 with lines lw 2 dt (12,3) lc rgb contrast title 'dissipated by friction', \
     $energies using 1:4 with lines lw 2 lc rgb main title 'dissipated by damping', \
     $energies using 1:5 with lines lw 2 dt (4,2) lc rgb soft title 'elastic', \
     $energies using 1:6 with lines lw 1.4 dt (2,3) lc rgb muted title 'kinetic'
