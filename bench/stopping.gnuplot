# Error of the peak over the strain at which a rule ends a test. $before, $now: strain [%], error [%];
# errors below 0.05 % lie on the axis.
set xrange [0:15.5]
set logscale y
set yrange [0.04:100]
set ytics (0.1,0.5,3,10,100)
set xlabel 'Axial strain at which the test ends (%)'
set ylabel 'Error of the peak (%)'
set key top right
set arrow 1 from 0,0.5 to 15.5,0.5 nohead lc rgb muted dt (6,4)
set arrow 2 from 0,3 to 15.5,3 nohead lc rgb muted dt (6,4)
plot $before using 1:2 with points pt 6 ps 1.2 lw 1.6 lc rgb contrast title 'earlier rule', \
     $now using 1:2 with points pt 7 ps 0.9 lc rgb main title 'rule'
