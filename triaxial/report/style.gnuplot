# What all figures have in common. Colours: dark ink, one main colour, one contrast, greys.
ink = '#243039'
muted = '#66727c'
pale = '#e6eaed'
main = '#1d4f7c'
contrast = '#b4581d'
soft = '#7fa3bf'

set encoding utf8
set minussign
set border 3 lc rgb muted lw 1
set tics nomirror out scale 0.6 textcolor rgb ink
set grid lc rgb pale lw 1 lt 1
set key textcolor rgb ink samplen 2 spacing 1.25
set xlabel textcolor rgb ink
set ylabel textcolor rgb ink
set cblabel textcolor rgb ink
