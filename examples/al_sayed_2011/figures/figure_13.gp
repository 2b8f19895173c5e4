# Fig. 13: share of friction in the energy dissipated.
name = 'figure_13'
load 'style.gp'
set yrange [0:102]
set xlabel 'frequency (Hz)'
set ylabel 'E_{friction}/E_{tot} (%)'
set key title 'normal load' left
plot for [i=0:last] data index i using 1:2 with lines linewidth 2 dashtype 11 + i % 4 linecolor palette frac rank(i) title columnheader(1)
