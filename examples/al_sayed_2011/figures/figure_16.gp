# Fig. 16: amplitude of the peaks with and without viscous damping.
name = 'figure_16'
load 'style.gp'
set logscale y
set format y '10^{%T}'
set xrange [0:100]
set yrange [5e-4:10]
set xlabel 'stick τ (%)'
set ylabel 'peak amplitude A_{max} (m)'
set key inside top center
plot data index 0 using 1:2 with lines linestyle 1 title columnheader(1), \
     data index 1 using 1:2 with lines linestyle 2 title columnheader(1), \
     for [i=2:last] data index i using 1:2 with points linestyle 11 notitle
