# The sample from outside. $discs, back to front: x, y, radius [m], colour. A point out of sight makes
# the scale of the colours appear.
load 'box_frame.gnuplot'
plot $discs using 1:2:3:4 with circles lc rgb variable, \
     for [k=1:has_scale] '+' using (2*left-right):(2*bottom-top):(lowest) with points pt 7 ps 0.01 lc palette
