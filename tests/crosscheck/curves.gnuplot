# The curves of the triaxial test; `results` and `codes` (those that ran) from the command line.
set terminal pngcairo size 1200,1300 font 'DejaVu Sans,12'
set output results.'/curves.png'
set datafile separator ','
set datafile columnheaders
data = results.'/curves.csv'
name(code) = code eq 'grainfield' ? 'Grainfield' : code eq 'yade' ? 'YADE' : 'LAMMPS'
colour(code) = code eq 'grainfield' ? '#0b5fa5' : code eq 'yade' ? '#d1495b' : '#2f7d3b'
q(code, part) = column(code.'_q_'.part)/1e3
v(code, part) = -100*column(code.'_volumetric_'.part)
set style fill transparent solid 0.18 noborder
set grid lc '#dddddd'
set key bottom right reverse Left
set xrange [0:3]
set multiplot layout 3,1 title 'Triaxial test at 100 kPa, 6,000 spheres, one law: means of the runs, bands from least to most'
set ylabel 'deviator stress (kPa)'
plot for [c in codes] data u (100*column(1)):(q(c, 'least')):(q(c, 'most')) w filledcurves \
         lc rgb colour(c) notitle, \
     for [c in codes] data u (100*column(1)):(q(c, 'mean')) w l lw 2 lc rgb colour(c) title name(c)
unset key
set ylabel 'difference from the mean of Grainfield (kPa)'
d(c, part) = q(c, part) - q('grainfield', 'mean')
plot for [c in codes] data u (100*column(1)):(d(c, 'least')):(d(c, 'most')) w filledcurves \
         lc rgb colour(c) notitle, \
     for [c in codes] data u (100*column(1)):(d(c, 'mean')) w l lw 2 lc rgb colour(c)
set xlabel 'axial strain (%)'
set ylabel 'volume gained (%)'
plot for [c in codes] data u (100*column(1)):(v(c, 'least')):(v(c, 'most')) w filledcurves \
         lc rgb colour(c) notitle, \
     for [c in codes] data u (100*column(1)):(v(c, 'mean')) w l lw 2 lc rgb colour(c) title name(c)
unset multiplot
