# Lateral stresses over their target. $servo: axial strain, deviation across x and across z [%].
set lmargin at screen 0.075
set rmargin at screen 0.985
set tmargin at screen 0.95
set bmargin at screen 0.19
set xrange [0:last]
set yrange [-reach:reach]
set xlabel 'Axial strain ε_1 (%)' offset 0,0.3
set ylabel 'Deviation from target (%)' offset 0.5,0
set key top right horizontal
set object 1 rectangle from graph 0,first -0.5 to graph 1,first 0.5 fs solid 0.35 noborder fc rgb '#dbe5ec' behind
plot $servo using 1:2 with lines lw 1.5 lc rgb main title 'walls across x', \
     $servo using 1:3 with lines lw 1.5 lc rgb contrast title 'walls across z', \
     0 with lines lw 0.8 lc rgb muted notitle
