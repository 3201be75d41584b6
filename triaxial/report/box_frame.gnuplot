# What pictures of a box from outside share: the range of the picture, the box's edges with its
# sizes, and the scale of the colours. $edges: x, y of both ends; $middles: x, y of those along which
# the sizes stand; $palette: share, red, green, blue; $ticks of the scale, its own where empty.
at(block, column) = real(word(block, column))
do for [k=1:|$edges|] {
    set arrow from at($edges[k], 1),at($edges[k], 2) to at($edges[k], 3),at($edges[k], 4) nohead front lw 1 lc rgb '#80384048'
}
set label '{/:Italic x}  '.size_x.' m' at at($middles[1], 1),at($middles[1], 2) right offset -0.2,-1.1 tc rgb ink
set label '{/:Italic y}  '.size_y.' m' at at($middles[2], 1),at($middles[2], 2) center rotate by 90 offset -1.4,0 tc rgb ink
set label '{/:Italic z}  '.size_z.' m' at at($middles[3], 1),at($middles[3], 2) left offset 0.6,-1.1 tc rgb ink
unset border
unset tics
unset grid
unset key
set lmargin at screen 0
set rmargin at screen share
set tmargin at screen 1
set bmargin at screen 0
set xrange [left:right]
set yrange [bottom:top]
set style fill solid noborder
set palette model RGB file '$palette' using 1:2:3:4
set cbrange [lowest:highest]
if (logarithmic) { set logscale cb }
set cbtics out scale 0.5 textcolor rgb ink
if (|$ticks| > 0) { set cbtics () }
set for [k=1:|$ticks|] cbtics add (at($ticks[k], 1))
set cblabel quantity offset 0.1,0
set colorbox user origin screen share+0.012,0.3 size screen bar_width,0.4 noborder
