# Lateral stresses over their target. $servo: axial strain, deviation across x and across z [%].
load 'legend_above.gnuplot'
set xrange [0:last]
set yrange [low:high]
set xlabel 'Axial strain ε_1 (%)' offset 0,0.3
set ylabel 'Deviation from target (%)' offset 0.5,0
set object 1 rectangle from graph 0,first -0.5 to graph 1,first 0.5 fs solid 0.35 noborder fc rgb '#dbe5ec' behind
plot $servo using 1:2 with lines lw 1.5 lc rgb main title 'walls across {/:Italic x}', \
     $servo using 1:3 with lines lw 1.2 lc rgb '#e0955a' title 'walls across {/:Italic z}', \
     0 with lines lw 0.8 lc rgb muted notitle
