# Mohr circles at the peak with the failure envelope [kPa]. $circles: a circle each block, this run's
# first; `name` of each; $touch: where the envelope touches this run's.
set tmargin at screen upper
set bmargin at screen lower
set size ratio -1
set xrange [left:right]
set yrange [bottom:top]
set ytics step
set xlabel 'Normal stress σ (kPa)' offset 0,0.3
set ylabel 'Shear stress τ (kPa)' offset 0.5,0
set key at screen 0.02,0.99 left top vertical Left reverse samplen 2
if (labelled) {
    set label 'σ_3 = '.minor_text.' kPa' at minor,0 left offset 0.8,0.7 tc rgb ink
    set label 'σ_1 = '.major_text.' kPa' at major,0 right offset -0.8,0.7 tc rgb ink
}
colour(k) = k == 1 ? main : soft
dash(k) = k == 1 ? 1 : (k-2)%4 + 1
plot for [k=1:|name|] $circles index k-1 with filledcurves y1=0 fs transparent solid 0.10 \
         noborder lc rgb colour(k) notitle, \
     [left:right] intercept + slope*x with lines lw 1.6 lc rgb contrast title envelope, \
     for [k=1:|name|] $circles index k-1 with lines lw 2 dt dash(k) lc rgb colour(k) title name[k], \
     $touch with points pt 7 ps 0.6 lc rgb contrast notitle
