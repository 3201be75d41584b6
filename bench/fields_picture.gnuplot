# Random fields, a panel each grid with the methods that have points there. $points, named by number of
# the grid and method: time a cell [ns], largest covariance error [γ], θ_y [m].
colour(m) = m eq 'las-classic' ? contrast : m eq 'las' ? main : m eq 'cholesky' ? ink : soft
mark(m) = m eq 'las-classic' ? 5 : m eq 'las' ? 7 : m eq 'cholesky' ? 9 : 13
# Where errors of round-off are drawn: one method above the other.
exact(m) = m eq 'circulant' ? 4e-5 : 1e-4
error(m, e) = e > exact(m) ? e : exact(m)
# Correlation lengths beside the points; of the Cholesky factor, which does not care, once.
label(m, row, length) = m ne 'cholesky' ? sprintf('%g', length) : row == 0 ? 'any' : ''
part(g, m) = sprintf('[%d-%s]', g, m)

set multiplot layout 1,|grid|
set logscale xy
set xrange [3:3e5]
set yrange [2e-5:2]
set format x '10^{%T}'
set ytics ('exact' 1e-4, '0.001' 1e-3, '0.01' 1e-2, '0.1' 1e-1, '1' 1)
set grid lc rgb pale
set xlabel 'Time a cell, normals included (ns)'
set ylabel 'Largest covariance error (γ)'
set key at graph 0.98,0.72 right top
do for [g=1:|grid|] {
    set title grid[g].' cells; labels: {/Symbol q}_y in m'
    plot for [m in methods[g]] $points index part(g, m) using 1:(error(m, $2)) with points pt mark(m) ps 1.6 lc rgb colour(m) title m, \
         for [m in methods[g]] $points index part(g, m) using (m eq 'las-classic' ? $1 : NaN):(error(m, $2)):(label(m, $0, $3)) \
             with labels right offset -1.6,0 font ',9' textcolor rgb muted notitle, \
         for [m in methods[g]] $points index part(g, m) using (m ne 'las-classic' ? $1 : NaN):(error(m, $2)):(label(m, $0, $3)) \
             with labels left offset 1.6,0 font ',9' textcolor rgb muted notitle
}
unset multiplot
