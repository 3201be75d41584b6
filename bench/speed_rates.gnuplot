# Speed by instruction set and precision, one and two threads side by side. $bars: place, 10^6
# sphere-steps a second, threads; a pair stands at 0, 1, ... and is called by its isa and precision.
set boxwidth 0.3
set style fill solid 1 noborder
set yrange [0:*]
set xrange [-0.6:|isa|-1+0.6]
unset grid
set grid ytics lc rgb pale
set bmargin 4
set ylabel '10^6 sphere-steps a second'
set key top left Left reverse
set xtics () scale 0
set for [k=1:|isa|] xtics add (isa[k]."\n".precision[k] k-1)
plot $bars using 1:($3 == 1 ? $2 : NaN) with boxes lc rgb soft title '1 thread', \
     $bars using 1:($3 == 2 ? $2 : NaN) with boxes lc rgb main title '2 threads', \
     $bars using 1:2:(sprintf('%.1f', $2)) with labels offset 0,0.6 font ',11' textcolor rgb ink notitle
