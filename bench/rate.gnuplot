# Strain rate and damping, a column a sample, a curve a damping. $points, blocks by sample and then
# damping: rate [1/s], largest q [kPa] and its deviation, share of damping [%]; $limits, a row a
# sample: limit of q, its interval [kPa]; counts: dampings of each sample.
colour(b) = b == 0 ? soft : b == 1 ? main : b == 2 ? contrast : ink
type(b) = b % 2 == 0 ? 7 : 6
set multiplot
unset key
do for [b=0:|dampings|-1] {
    set label b+1 'damping '.dampings[b+1] at screen 0.2+0.17*b,0.965 point pt type(b) ps 1.1 lc rgb colour(b) offset 1,0
}
set logscale x
set xrange [0.0013:0.6]
first_block = 0
do for [s=1:samples] {
    blocks = int(counts[s])
    left = 0.03 + (s - 1) * 0.965 / samples
    set lmargin at screen left + 0.04
    set rmargin at screen left + 0.965 / samples - 0.01
    set tmargin at screen 0.87
    set bmargin at screen 0.47
    set title names[s] offset 0,-0.6
    set xtics ('' 0.002, '' 0.01, '' 0.05, '' 0.2)
    unset xlabel
    set ylabel s == 1 ? 'Largest {/:Italic q} (kPa)' : '' offset 0.5,0
    set yrange [0:*]
    stats $limits every ::s-1::s-1 using 1 name 'limit' nooutput
    stats $limits every ::s-1::s-1 using 2 name 'low' nooutput
    stats $limits every ::s-1::s-1 using 3 name 'high' nooutput
    set object 1 rectangle from graph 0,first low_max to graph 1,first high_max fs solid 0.18 noborder fc rgb main behind
    set arrow 1 from graph 0,first limit_max to graph 1,first limit_max nohead lw 1 dt (6,4) lc rgb main
    plot for [b=0:blocks-1] $points index first_block+b using 1:2:3 with yerrorlines \
             pt type(b) ps 0.8 lw 1.4 lc rgb colour(b) notitle
    unset object 1
    unset arrow 1
    unset title
    unset label
    set tmargin at screen 0.43
    set bmargin at screen 0.105
    set xtics ('0.002' 0.002, '0.01' 0.01, '0.05' 0.05, '0.2' 0.2)
    set xlabel 'Strain rate (1/s)' offset 0,0.4
    set ylabel s == 1 ? 'Share of damping (%)' : '' offset 0.8,0
    set yrange [0:100]
    plot for [b=0:blocks-1] $points index first_block+b using 1:4 with linespoints \
             pt type(b) ps 0.8 lw 1.4 lc rgb colour(b) notitle
    first_block = first_block + blocks
}
unset multiplot
