# Stresses over depth in the settled sample. $profile: depth [m], stress measured vertical, along x
# and z, in theory vertical and horizontal [kPa].
load 'legend_above.gnuplot'
set key maxrows 2
set xrange [0:*]
set yrange [deepest:0]
set xlabel 'Stress (kPa)' offset 0,0.3
set ylabel 'Depth (m)' offset 0.5,0
plot $profile using 5:1 with lines lw 1.6 lc rgb main title 'γ{/:Italic z}', \
     $profile using 2:1 with points pt 7 ps 0.6 lc rgb main title 'vertical', \
     $profile using 6:1 with lines lw 1.6 dt (6,4) lc rgb contrast title '{/:Italic K}_0γ{/:Italic z}', \
     $profile using 3:1 with points pt 4 ps 0.6 lc rgb contrast title 'horizontal, x', \
     $profile using 4:1 with points pt 6 ps 0.7 lc rgb contrast title 'horizontal, z'
