# Mohr circles at the peak with the failure envelope [kPa]. $circles: a circle each block, this run's
# first; $touch: where the envelope touches it.
set lmargin at screen 0.135
set rmargin at screen 0.975
set tmargin at screen upper
set bmargin at screen lower
set size ratio -1
set xrange [left:right]
set yrange [bottom:top]
set xlabel 'Normal stress σ (kPa)' offset 0,0.3
set ylabel 'Shear stress τ (kPa)' offset 0.5,0
set key top left reverse Left
# More circles leave no room for the stresses.
if (circles == 1) {
    set label 'σ_3 = '.minor_text at minor,0 right offset -0.5,0.7 tc rgb ink
    set label 'σ_1 = '.major_text at major,0 right offset -0.5,0.7 tc rgb ink
}
colour(k) = k == 1 ? main : soft
plot for [k=1:circles] $circles index k-1 with filledcurves y1=0 fs transparent solid 0.10 \
         noborder lc rgb colour(k) notitle, \
     for [k=1:circles] $circles index k-1 with lines lw 2 lc rgb colour(k) notitle, \
     [left:right] intercept + slope*x with lines lw 1.6 lc rgb contrast \
         title 'τ = '.intercept_text.' + σ tan '.angle_text.'°', \
     $touch with points pt 7 ps 0.6 lc rgb contrast notitle
