# Long rest. $rests, named by state, kernels and damping: steps, kinetic over elastic energy at the
# start, change of the mean stress. The reference is pale and wide, mixed precision dashed.
set multiplot
set logscale xy
set format y '10^{%T}'
set xrange [1:1.2e6]
set xtics ('1' 1, '10' 10, '10^2' 100, '10^3' 1e3, '10^4' 1e4, '10^5' 1e5, '10^6' 1e6)
set xlabel 'Steps (-)'
set tmargin at screen 0.96
set bmargin at screen 0.14

array name[3] = ['[compressed-%s-0.2]', '[settled-%s-0]', '[settled-%s-0.2]']
array what[3] = ['as compressed', 'undamped', 'damped']
part(k, kernels) = sprintf(name[k], kernels)
colour(k) = word(ink.' '.contrast.' '.main, k)
pale_colour(k) = word('#d9dcdf #f0d3bb #c3d5e2', k)

set lmargin at screen 0.11
set rmargin at screen 0.48
set yrange [1e-32:1]
set ylabel 'Kinetic over elastic energy at the start (-)' offset 1,0
set key bottom left Left reverse samplen 1.2
plot for [k=1:3] $rests index part(k, 'reference') using 1:2 with lines lw 6 lc rgb pale_colour(k) title '', \
     for [k=1:3] $rests index part(k, 'double') using 1:2 with lines lw 1.8 lc rgb colour(k) title what[k], \
     for [k=1:3] $rests index part(k, 'mixed') using 1:2 with lines lw 1.8 dt 2 lc rgb colour(k) title '', \
     NaN with lines lw 6 lc rgb '#d9dcdf' title 'pale: reference', \
     NaN with lines lw 1.8 dt 2 lc rgb '#66727c' title 'dashed: mixed'

set lmargin at screen 0.61
set rmargin at screen 0.98
set yrange [1e-11:1]
set ylabel 'Change of the mean stress (-)' offset 0,0
unset key
plot for [k=1:3] $rests index part(k, 'reference') using 1:3 with lines lw 6 lc rgb pale_colour(k), \
     for [k=1:3] $rests index part(k, 'double') using 1:3 with lines lw 1.8 lc rgb colour(k), \
     for [k=1:3] $rests index part(k, 'mixed') using 1:3 with lines lw 1.8 dt 2 lc rgb colour(k)
unset multiplot
