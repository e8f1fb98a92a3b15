# SPDX-License-Identifier: MIT
# gnuplot -e "csv='mobile.csv'; png='mobile.png'" bench/mobile/chart.gp: time of a step against joints, both axes
# logarithmic. A straight line of slope one is a cost linear in the joints; the line in grey has it.
set terminal pngcairo size 1000,620 font "DejaVu Sans,13"
set output png
set datafile separator ","
set logscale xy
set title "A mobile of rods on ball joints: time of a step of 10 ms, one thread"
set xlabel "joints"
set ylabel "time of a step [ms]"
set xtics (3, 7, 15, 31, 63, 127, 255, 511, 1023, 2047, 4095)
set xrange [2.5:5000]
set grid lc rgb "#dddddd"
set key top left reverse Left
names = '"ODE quick 50 iterations" "ODE quick 5 iterations" "Plumb trees in 5 substeps" "Plumb iterated 5 times" "Plumb trees"'
colours = '"#c06000" "#e0a63f" "#7fb3d9" "#5fa55a" "#1f6fb2"'
titles = '"ODE quick step, 50 iterations" "ODE quick step, 5 iterations (comes apart from 511 joints on)" "Plumb, trees in 5 substeps (gaps below 1 µm)" "Plumb, joints iterated 5 times (gaps of centimetres, diverges at 4095)" "Plumb as it comes: trees, one substep (gaps below 1 µm)"'
of(i) = "< awk -F, -v name='" . word(names, i) . "' '$2 == name' " . csv
plot for [i=1:5] of(i) using 1:3 with linespoints lw 2 pt 7 ps 0.9 lc rgb word(colours, i) title word(titles, i), \
  1.05e-4 * x with lines dt 2 lc rgb "#999999" title "linear"
