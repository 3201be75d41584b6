# Histogram and fitted distributions, best first. $bins: middle, density, width; $fits: value, density
# of each fit; of each its family and its AIC above the best.
set xrange [low:high]
set yrange [0:*]
set xlabel symbol.' ('.unit.')' offset 0,0.3
set ylabel 'Probability density (1/'.unit.')' offset 0.5,0
set style fill solid 0.5 border lc rgb '#ffffff'
load 'legend_above.gnuplot'
set key maxrows 2
asked(f) = family[f] eq 'lognormal'
width(f) = asked(f) ? 2.4 : 1.3
dash(f) = asked(f) ? 1 : f + 1
colour(f) = asked(f) ? contrast : muted
plot $bins using 1:2:3 with boxes lc rgb soft notitle, \
     for [f=1:|family|] $fits using 1:f+1 with lines lw width(f) dt dash(f) lc rgb colour(f) \
         title family[f].sprintf(', AIC %+.1f', aic[f])
