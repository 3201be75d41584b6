# Sieve curve. $sieves: diameter [mm], passing of target and sample [%]; $target, $achieved: diameter
# [mm], passing [%]; $achieved may be empty.
load 'legend_above.gnuplot'
set logscale x
set xrange [low:high]
set yrange [0:104]
set ytics 20
sieve(k) = real(word($sieves[k], 1))
# Sieves that are too close to have their diameters side by side stay without.
set xtics ()
room = 0.065*log(high/low)
last = 0
do for [k=1:|$sieves|] {
    if (last == 0 || log(sieve(k)/last) > room) {
        set xtics add (sprintf('%.4g', sieve(k)) sieve(k))
        last = sieve(k)
    } else {
        set xtics add ('' sieve(k))
    }
}
set xlabel 'Diameter (mm)' offset 0,0.3
set ylabel 'Passing (% by mass)' offset 0.5,0
if (|$achieved| > 0) {
    plot $target with lines lw 1.6 dt (6,4) lc rgb contrast title 'target', \
         $achieved with steps lw 1.8 lc rgb main title 'this sample', \
         $sieves using 1:3 with points pt 7 ps 0.6 lc rgb main title 'at the sieves'
} else {
    plot $target with lines lw 1.6 dt (6,4) lc rgb contrast title 'target', \
         $sieves using 1:3 with points pt 7 ps 0.6 lc rgb main title 'this sample at the sieves'
}
