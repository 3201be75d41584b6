# Contact forces at the end of the compression, and how runs part from each other on the way there;
# `work`, `results` and `peers` (those that ran) from the command line.
set terminal pngcairo size 1400,1150 font 'DejaVu Sans,12'
set output results.'/forces.png'
set datafile separator ','
set datafile columnheaders
set datafile missing 'nan'
scatter = work.'/scatter.csv'
differences = results.'/forces.csv'
name(code) = code eq 'yade' ? 'YADE' : code eq 'lammps' ? 'LAMMPS' : code eq 'half' ? \
             'Grainfield, half the step' : 'Grainfield, start moved by 1e-12 m'
colour(code) = code eq 'yade' ? '#d1495b' : code eq 'lammps' ? '#2f7d3b' : code eq 'half' ? \
               '#0b5fa5' : '#8a8a8a'
mark(code) = code eq 'yade' ? 6 : 7
size(code) = code eq 'yade' ? 0.8 : 0.25
set grid lc '#dddddd'
set multiplot layout 2,2 title 'Contact forces of an isotropic compression to 130 kPa, contact by contact'
set key top left reverse Left
set logscale xy
set format '10^{%T}'
set xlabel 'normal force in Grainfield (N)'
set ylabel 'normal force in the other code (N)'
set xrange [0.1:500]
set yrange [0.1:500]
plot x lc rgb '#bbbbbb' notitle, \
     for [c in peers] scatter u (column('normal')):(column(c.'_normal')) w p pt mark(c) ps size(c) \
         lc rgb colour(c) title name(c)
set xlabel 'shear force in Grainfield (N)'
set ylabel 'shear force in the other code (N)'
set xrange [0.01:100]
set yrange [0.01:100]
plot x lc rgb '#bbbbbb' notitle, \
     for [c in peers] scatter u (column('shear')):(column(c.'_shear')) w p pt mark(c) ps size(c) \
         lc rgb colour(c) title name(c)
set key bottom right reverse Left
set xlabel 'steps of 5 µs'
set ylabel 'RMS difference from Grainfield over RMS force'
set xrange [80:4000]
set yrange [1e-8:1e-1]
set format x '%g'
runs = peers.' half nudged'
row(c, what) = strcol('test') eq 'compression' && strcol('first') eq 'grainfield' && \
               strcol('second') eq c ? column(what) : NaN
set datafile missing NaN
do for [what in 'normal shear'] {
    set title what.' forces'
    plot for [c in runs] differences u (column('steps')):(row(c, what.'_difference')) w lp lw 2 pt 7 \
             lc rgb colour(c) title name(c)
}
unset multiplot
