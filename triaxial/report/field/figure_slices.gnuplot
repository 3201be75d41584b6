# Slices x-y of the cells, side by side, at each z [m]. $cells: middle x, y, edges x, x, y, y, value.
do for [k=1:|z|] {
    middle = (k-1)*pace + width/2
    set label sprintf('{/:Italic z} = %.4g m', z[k]) at middle,height center offset 0,0.8 tc rgb ink
    set label sprintf('{/:Italic x} 0 … %.4g m', width) at middle,0 center offset 0,-0.9 tc rgb ink
}
if (to_scale) { set size ratio -1 } else { set size noratio }
unset border
unset grid
unset xtics
set ytics nomirror out scale 0.4
set ylabel '{/:Italic y} (m)' offset 1.5,0
unset key
set lmargin at screen 120.0/pixels_wide
set rmargin at screen 1 - 200.0/pixels_wide
set tmargin at screen 1 - 55.0/pixels_high
set bmargin at screen 40.0/pixels_high
set xrange [0:total]
set yrange [0:height]
set palette model RGB file '$palette' using 1:2:3:4
set cblabel quantity offset 0.8,0
set colorbox user origin screen 1 - 185.0/pixels_wide,0.2 size screen 22.0/pixels_wide,0.55 noborder
set style fill solid noborder
plot $cells using 1:2:3:4:5:6:7 with boxxyerror lc palette
