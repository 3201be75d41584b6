# Correlation of the cells: above as it is, below how far the estimates are off, which shows the
# bands. $correlation, an axis each block: lag [m], estimated, exact, the band.
axis = 'xyz'
set multiplot layout 2,3
set tmargin 2.6
set bmargin 2
set yrange [*<-0.1:1.12]
set key at screen 0.5,0.99 center top horizontal samplen 1.2 width -1 font ',11'
do for [d=1:3] {
    set xrange [low[d]:high[d]]
    set ylabel (d == 1 ? 'Correlation (-)' : '') offset 1,0
    plot $correlation index d-1 using 1:4:5 with filledcurves lc rgb soft fs transparent solid 0.45 title (d == 1 ? sprintf('%d %% band', band) : ''), \
         '' index d-1 using 1:3 with lines lw 1.6 lc rgb main title (d == 1 ? 'exact' : ''), \
         '' index d-1 using 1:2 with points pt 7 ps 0.45 lc rgb contrast title (d == 1 ? 'estimated' : '')
}
set yrange [*:*]
set tmargin 0.6
set bmargin 3.4
unset key
do for [d=1:3] {
    set xrange [low[d]:high[d]]
    set xlabel 'Lag in {/:Italic '.axis[d:d].'} (m)' offset 0,0.3
    set ylabel (d == 1 ? 'Estimated − exact (-)' : '') offset 1,0
    plot $correlation index d-1 using 1:($4-$3):($5-$3) with filledcurves lc rgb soft fs transparent solid 0.45 notitle, \
         0 with lines lw 1.6 lc rgb main notitle, \
         '' index d-1 using 1:($2-$3) with points pt 7 ps 0.45 lc rgb contrast notitle
}
unset multiplot
