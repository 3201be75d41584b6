# Curves of a series of repeats. $curves, a repeat each block: axial strain [%], deviator stress
# [kPa]; $peaks: the same of each repeat's largest stress.
set xrange [0:last]
set yrange [lowest:highest]
set xlabel 'Axial strain ε_1 (%)' offset 0,0.3
set ylabel 'Deviator stress {/:Italic q} (kPa)' offset 0.5,0
set key bottom right
others = repeats == 2 ? 'repeat 1' : 'repeats 1 to '.(repeats - 1)
plot for [k=1:repeats-1] $curves index k using 1:2 with lines lw 1 lc rgb soft \
         title (k == 1 ? others : ''), \
     $curves index 0 using 1:2 with lines lw 1.4 lc rgb main title 'repeat 0, not shifted', \
     $peaks using 1:2 with points pt 7 ps 0.7 lc rgb contrast title 'largest of each'
