# The largest stable step. $bounds: contrast; over the measured limit, undamped: the estimate, the limit
# with damping, the bounds (neighbours fixed, sum of stiffness, caught), the solver's step.
set lmargin at screen 0.1
set rmargin at screen 0.67
set tmargin at screen 0.95
set bmargin at screen 0.15
set logscale x
set xrange [0.7:14000]
set yrange [0:1.5]
set xtics ('1' 1, '10' 10, '100' 100, '1000' 1000, '10 000' 10000)
set xlabel 'Stiffness contrast, largest over smallest (-)'
set ylabel 'Step over the measured limit, undamped (-)' offset 1,0
set key at screen 0.69,0.95 left top Left reverse samplen 1.6 spacing 1.6
set arrow from graph 0,first 1 to graph 1,first 1 nohead lw 1.2 lc rgb muted back
plot $bounds using 1:3 with linespoints pt 4 ps 1.5 lw 1.5 dt 2 lc rgb contrast title 'limit with damping 0.2', \
     $bounds using 1:2 with linespoints pt 7 ps 1.5 lw 2 lc rgb main title 'estimate 2/ω_{max}', \
     $bounds using 1:7 with linespoints pt 5 ps 1.2 lw 2 lc rgb ink title 'step of the solver', \
     $bounds using 1:4 with linespoints pt 9 ps 1.4 lw 1.5 lc rgb soft title 'bound: neighbours fixed', \
     $bounds using 1:5 with linespoints pt 11 ps 1.4 lw 1.5 lc rgb soft title 'bound: 2 √(m/ΣK_n)', \
     $bounds using 1:6 with linespoints pt 13 ps 1.4 lw 1.5 lc rgb soft title 'bound: caught between others'
