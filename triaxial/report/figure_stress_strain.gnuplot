# Deviator stress and, below it, volumetric strain. $curve: axial strain [%], deviator stress [kPa],
# volumetric strain [%]; $marks: the secant to half the peak and on, half the peak, the peak. The two
# panels share their left margin, which has room for their widest label of a tick.
set multiplot
load 'legend_above.gnuplot'
set key width -6
set lmargin widest + 4
set rmargin at screen 0.975
set xrange [0:last]
name_at = -(widest + 2.4)

set tmargin at screen 0.925
set bmargin at screen 0.45
set yrange [floor_stress:1.16*peak]
set ytics stress_step
set format x ''
set label 3 'Deviator stress {/:Italic q} (kPa)' at graph 0,graph 0.5 center rotate by 90 offset character name_at,0 tc rgb ink
peak_label = peak_name.' '.peak_text.' kPa at '.peak_strain_text.' %'
if (peak_strain > 0.6*last) {
    set label 1 peak_label at peak_strain,peak right offset -0.5,1.0 tc rgb ink
} else {
    set label 1 peak_label at peak_strain,peak left offset 0.5,1.0 tc rgb ink
}
plot $curve using 1:2 with lines lw 2 lc rgb main title 'measured at the walls', \
     $marks index 0 with lines lw 1.4 dt (6,4) lc rgb contrast title 'secant {/:Italic E}_{50} = '.modulus_text.' MPa', \
     $marks index 1 with points pt 7 ps 0.7 lc rgb contrast notitle, \
     $marks index 2 with points pt 7 ps 0.8 lc rgb main notitle
unset label
unset key

set tmargin at screen 0.41
set bmargin at screen 0.115
set yrange [*:*]
set offsets 0,0,graph 0.08,graph 0.08
set ytics volumetric_step
set format x '%g'
set xlabel 'Axial strain ε_1 (%)' offset 0,0.3
set label 3 'Volumetric strain (%)' at graph 0,graph 0.5 center rotate by 90 offset character name_at,0 tc rgb ink
set xzeroaxis lc rgb muted lw 1 dt (2,3)
plot $curve using 1:3 with lines lw 2 lc rgb soft notitle
unset multiplot
