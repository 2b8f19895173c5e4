# Figures of docs/performance.md from the data that bench/page wrote: gnuplot -c bench/performance.gp FOLDER docs/figures
data(name) = ARG1."/".name.".dat"
set terminal pngcairo size 2000, 1300 font "DejaVu Sans,15"
set logscale xy
set grid lc rgb "#dddddd"
set key top left Left reverse
set format y "10^{%T}"
blue = "#0072b2"
orange = "#d55e00"
green = "#009e73"
violet = "#cc79a7"

set output ARG2."/cost.png"
set multiplot layout 2, 2 margins 0.06, 0.985, 0.07, 0.96 spacing 0.07, 0.12
set ylabel "time of a response (ms)"
set title "harmonics: the paper's oscillator"
set xlabel "order N"
set xtics (1, 3, 7, 15, 27, 55, 101)
set xrange [0.9:120]
plot data("harmonics") using 1:2 with linespoints lw 2 pt 7 lc rgb blue title "response", \
     data("harmonics") using 1:3 with linespoints lw 2 dt 2 pt 6 lc rgb blue title "its LU factorizations alone"
set title "degrees of freedom: one damper"
set xlabel "degrees of freedom"
set xtics auto
set autoscale x
set format x "10^{%T}"
set ylabel ""
plot data("masses") using 1:2 with linespoints lw 2 pt 7 lc rgb blue title "chain, response", \
     data("masses") using 1:3 with linespoints lw 2 dt 2 pt 6 lc rgb blue title "chain, without its modes and first response", \
     data("beam") using 1:2 with linespoints lw 2 pt 7 lc rgb orange title "beam, response", \
     data("beam") using 1:3 with linespoints lw 2 dt 2 pt 6 lc rgb orange title "beam, without its modes and first response"
set format x "%g"
set title "contacts"
set xlabel "friction dampers"
set xtics (1, 2, 5, 10, 20, 50)
set xrange [0.9:60]
set ylabel "time of a response (ms)"
plot data("contacts") using 1:2 with linespoints lw 2 pt 7 lc rgb blue title "chain of 20 masses", \
     data("ring") using 1:2 with linespoints lw 2 pt 7 lc rgb green title "bladed ring, a damper for each blade"
set title "points: the paper's oscillator, N = 7, shorter steps"
set xlabel "points"
set xtics (150, 300, 600, 1200, 2400)
set xrange [130:3000]
set ylabel ""
plot data("points") using 1:2 with linespoints lw 2 pt 7 lc rgb blue title "response"
unset multiplot

set terminal pngcairo size 1600, 1000 font "DejaVu Sans,16"
set output ARG2."/speed_for_accuracy.png"
unset title
set xtics auto
set autoscale x
set format x "10^{%T}"
set xlabel "time of the frequency response (ms)"
set ylabel "relative error of the amplitude at the peak"
set yrange [*:1e-1]
set key bottom right Left reverse
plot data("exact") using 1:2 with linespoints lw 2 pt 7 lc rgb blue title "harmonic balance, exact integrals, N = 1 to 201", \
     data("chosen") using 1:2 with points lw 2 pt 4 ps 2.5 lc rgb blue title "the same, order chosen by an accuracy", \
     for [i = 0:2] data("chosen") every ::i::i using 1:2:3 with labels left offset 1, 0.8 + 0.9*(2 - i) tc rgb blue notitle, \
     data("chosen") every ::3 using 1:2:3 with labels left offset 1, 0.8 tc rgb blue notitle, \
     data("sampled") using 1:2 with points pt 6 ps 1.3 lc rgb orange title "harmonic balance, sampled friction", \
     data("newmark") using 1:2 with linespoints lw 2 pt 5 lc rgb green title "shooting, Newmark's method, 150 frequencies", \
     data("event_driven") using 1:2 with points lw 2 pt 9 ps 2 lc rgb violet title "shooting, exact in time, 150 frequencies"

set terminal pngcairo size 1400, 900 font "DejaVu Sans,16"
set output ARG2."/bratu_time.png"
unset yrange
set autoscale y
set key top left
set xlabel "unknowns"
set ylabel "time of the branch (s)"
set xrange [700:1.5e6]
stats data("bratu") using ($2/$1) every ::0::0 nooutput
plot data("bratu") using 1:2 with linespoints lw 2 pt 7 lc rgb blue title "Bratu's problem", \
     STATS_max*x with lines dt 2 lc rgb "#888888" title "proportional to the unknowns"
