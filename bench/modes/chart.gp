# SPDX-License-Identifier: MIT
# gnuplot -e "csv='modes.csv'; png='modes.png'" bench/modes/chart.gp: the greatest factor by which a small disturbance
# of three and six cubes at rest grows in a step of 10 ms, against iterations. Above 1 it grows for ever.
set terminal pngcairo size 1000,620 font "DejaVu Sans,13"
set output png
set datafile separator ","
set logscale x
set title "How a small disturbance of stacked cubes grows in a step of 10 ms: below 1 it dies away"
set xlabel "iterations of either pass"
set ylabel "growth in a step"
set xtics (1, 2, 5, 10, 20, 50)
set xrange [0.9:56]
set yrange [0.94:1.13]
set grid lc rgb "#dddddd"
set key bottom right reverse Left
of(cubes, method, n) = sprintf("< awk -F, '$1 == \"%s cubes\" && $2 == \"%s\" && $3 == 10 && $4 == %s' %s", cubes, method, n, csv)
plot of("3", "paper", "1") using 5:6 with linespoints lw 2 pt 7 lc rgb "#c06000" title "3 cubes, to the paper's letter", \
     of("3", "swept", "1") using 5:6 with linespoints lw 2 pt 7 lc rgb "#e0a63f" title "3 cubes, swept (exact\\_islands 0)", \
     of("6", "swept", "1") using 5:6 with linespoints lw 2 pt 5 lc rgb "#7fb3d9" title "6 cubes, swept", \
     of("6", "swept", "4") using 5:6 with linespoints lw 2 pt 9 lc rgb "#5fa55a" title "6 cubes, swept, 4 substeps", \
     of("3", "exact", "1") using 5:6 with linespoints lw 2 pt 7 lc rgb "#1f6fb2" title "3 cubes as they come: one system", \
     of("6", "exact", "1") using 5:6 with linespoints lw 2 pt 5 lc rgb "#10406a" title "6 cubes as they come", \
     1 with lines dt 2 lc rgb "#999999" notitle
