# Run time against error; a row of panels each series, left of the peak, right of E50. $panels: row,
# right or not, noise floor [%], time [s] and error [%] of the reference and, where there is one, of the
# default. A panel each block: $points: time, error, point type, mass scaling; $fronts: time, error.
at(p, column) = real(word($panels[p], column))
colour(scaling) = scaling < 1.5 ? main : scaling < 3 ? soft : contrast
number(rgb) = int('0x'.rgb[2:*])
height = (0.985 - 0.15)/|series|

set multiplot
set logscale xy
set xtics (0.2,0.5,1,2,5,10,20,50,100,200,500)
set ytics (0.1,0.2,0.5,1,2,5,10,20,50,100)
do for [p=1:|$panels|] {
    row = at(p, 1)
    is_right = at(p, 2) == 1
    floor_error = at(p, 3)
    is_lowest = row + 1 == |series|
    set lmargin at screen (is_right ? 0.545 : 0.075)
    set rmargin at screen (is_right ? 0.99 : 0.52)
    set tmargin at screen 0.985 - row*height
    set bmargin at screen 0.985 - (row + 1)*height + 0.02
    set xrange [first_time:last_time]
    set yrange [lowest:highest]
    unset label
    unset arrow
    unset object
    set object 1 rectangle from first_time,lowest to last_time,floor_error fc rgb pale fs solid noborder behind
    set label 1 sprintf('noise floor: scatter of one reference run, %.1f %%', floor_error) at graph 0.02, graph 0.04 left tc rgb muted
    set label 2 series[row + 1].(is_right ? ': {/:Italic E}_{50}' : ': peak deviator stress') at graph 0.98, graph 0.95 right tc rgb ink
    set xlabel (is_lowest ? 'Time of a realization on one core (s)' : '')
    set ylabel (is_right ? '' : 'Error of one run (%)') offset 1,0
    set format x (is_lowest ? '%g' : '')
    set format y (is_right ? '' : '%g')
    set label 3 'reference' at at(p, 4),at(p, 5) right offset 1.5,-1 tc rgb muted front
    if (words($panels[p]) > 5) {
        set label 4 'default' at graph 0.03,0.33 left tc rgb ink front
        set arrow 1 from graph 0.155,0.345 to at(p, 6),at(p, 7) nohead lw 1.2 lc rgb ink back
        set label 5 '' at at(p, 6),at(p, 7) point pt 6 ps 3.4 lw 2.5 lc rgb ink front
    }
    plot $fronts index p-1 using 1:2 with steps lw 2 dt (6,4) lc rgb muted notitle, \
         $points index p-1 using 1:2:(number(colour($4))) with lines lw 1 lc rgb variable notitle, \
         $points index p-1 using 1:2:(1.5):3:(number(colour($4))) with points ps variable pt variable lw 1.6 lc rgb variable notitle
}

# The legend, drawn as a plot without axes: place, point type (0: none), mass scaling, text.
$legend << EOD
0.02 0.75 7 1 "real masses"
0.18 0.75 9 2 "mass scaling 2"
0.36 0.75 5 4 "mass scaling 4"
0.55 0.75 0 1 "lines: other safety, 0.2 to 0.95 of the limit"
0.02 0.25 7 1 "mixed precision"
0.18 0.25 6 1 "double precision"
0.36 0.25 2 1 "reference kernels"
0.55 0.25 0 1 "dashes: Pareto front"
EOD
set lmargin at screen 0.08
set rmargin at screen 0.99
set bmargin at screen 0.005
set tmargin at screen 0.075
unset logscale
unset border
unset tics
unset grid
unset label
unset object
unset arrow
set xlabel ''
set ylabel ''
set xrange [0:1]
set yrange [0:1]
plot $legend using ($3 > 0 ? $1 : NaN):2:(1.5):3:(number(colour($4))) with points ps variable pt variable lw 1.6 lc rgb variable notitle, \
     $legend using 1:2:5 with labels left offset 1.4,0 tc rgb ink notitle
unset multiplot
