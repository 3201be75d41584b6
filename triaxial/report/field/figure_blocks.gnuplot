# The blocks from outside. $faces: x, y of four corners [m], colour.
load 'box_frame.gnuplot'
do for [k=1:|$faces|] {
    x(c) = at($faces[k], 2*c - 1)
    y(c) = at($faces[k], 2*c)
    set object polygon from x(1),y(1) to x(2),y(2) to x(3),y(3) to x(4),y(4) to x(1),y(1) fc rgb int(at($faces[k], 9)) fs solid border lc rgb '#a0384048' lw 0.6
}
plot '+' using (2*left-right):(2*bottom-top):(lowest) with points pt 7 ps 0.01 lc palette
