# The correlation function. $points: lag [m], correlation for each of the lengths; that of the field
# is number `own`.
set xlabel 'Lag τ_x = τ_y = τ_z (m)' offset 0,0.3
set ylabel 'Correlation (-)' offset 1,0
set logscale x
set format x '%g'
set xrange [shortest:longest]
set yrange [*<0:1.02]
set key outside right center Left reverse
width(k) = k == own ? 2.6 : 1.5
dash(k) = k == own ? 1 : k + 1
colour(k) = k == own ? contrast : main
plot for [k=1:|theta|] $points using 1:k+1 with lines lw width(k) dt dash(k) lc rgb colour(k) \
         title sprintf('θ_y = %.3g m', theta[k]).(k == own ? ', this field' : '')
