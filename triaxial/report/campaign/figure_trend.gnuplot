# Mean and deviation against a key. $trends, a line of cases each block: the key's value, mean, its
# interval, deviation, its interval, the deterministic run's result. One legend over both panels.
set multiplot layout 1,2
set tmargin at screen upper
set bmargin at screen lower
if (wide) { set logscale x }
set xrange [left:right]
set xlabel axis offset 0,0.3
set key at screen 0.02,0.99 left top horizontal Left reverse maxcols columns samplen 2 width 1 spacing 1 font ',11'
colour(t) = word(main.' '.contrast.' #3c7a4e '.muted.' '.soft.' #8a5a9e', (t-1)%6 + 1)
mark(t) = int(word('7 5 9 13 4 6', (t-1)%6 + 1))
set ylabel 'Mean of '.symbol.' ('.unit.')' offset 0.5,0
set yrange [low:high]
plot for [t=1:|name|] $trends index t-1 using 1:2:3:4 with yerrorlines pt mark(t) ps 0.6 lw 1.6 \
         lc rgb colour(t) title name[t], \
     for [t=1:has_deterministic*|name|] $trends index t-1 using 1:8 with lines dt 2 lw 1.2 \
         lc rgb colour(t) title (t == 1 ? 'deterministic' : '')
unset key
set yrange [0:most]
set ylabel 'Standard deviation of '.symbol.' ('.unit.')' offset 0.5,0
plot for [t=1:|name|] $trends index t-1 using 1:5:6:7 with yerrorlines pt mark(t) ps 0.6 lw 1.6 \
         lc rgb colour(t) notitle
unset multiplot
