# Mean and deviation against a key. $trends, a line of cases each block: the key's value, mean, its
# interval, deviation, its interval, the deterministic run's result.
set multiplot layout 1,2
set offsets graph 0.05, graph 0.05, graph 0.05, graph 0.05
if (wide) { set logscale x }
set xlabel axis offset 0,0.3
set key above left font ',11' maxrows 6
colour(t) = word(main.' '.contrast.' #3c7a4e '.muted.' '.soft.' #8a5a9e', (t-1)%6 + 1)
set ylabel 'Mean of '.symbol.' ('.unit.')' offset 0.5,0
if (has_deterministic) {
    plot for [t=1:|name|] $trends index t-1 using 1:2:3:4 with yerrorlines pt 7 ps 0.6 lw 1.6 \
             lc rgb colour(t) title name[t], \
         for [t=1:|name|] $trends index t-1 using 1:8 with lines dt 2 lw 1.2 \
             lc rgb colour(t) title (t == 1 ? 'deterministic' : '')
} else {
    plot for [t=1:|name|] $trends index t-1 using 1:2:3:4 with yerrorlines pt 7 ps 0.6 lw 1.6 \
             lc rgb colour(t) title name[t]
}
set offsets graph 0.05, graph 0.05, graph 0.05, 0
set yrange [0:*]
set ylabel 'Standard deviation of '.symbol.' ('.unit.')' offset 0.5,0
plot for [t=1:|name|] $trends index t-1 using 1:5:6:7 with yerrorlines pt 7 ps 0.6 lw 1.6 \
         lc rgb colour(t) notitle
unset multiplot
