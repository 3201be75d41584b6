# Growth with size. $sizes: spheres, time a sphere-step [ns], memory a sphere [B].
set multiplot
set logscale x
set xrange [3e3:2e6]
set format x '10^{%T}'
set xlabel 'Spheres (-)'
set yrange [0:*]
set grid lc rgb pale
unset key
set lmargin at screen 0.10
set rmargin at screen 0.48
set ylabel 'Time a sphere-step (ns)' offset 1,0
plot $sizes using 1:2 with linespoints pt 7 ps 1.4 lw 2 lc rgb main
set lmargin at screen 0.60
set rmargin at screen 0.98
set ylabel 'Memory a sphere (B)' offset 1,0
plot $sizes using 1:3 with linespoints pt 5 ps 1.4 lw 2 lc rgb contrast
unset multiplot
