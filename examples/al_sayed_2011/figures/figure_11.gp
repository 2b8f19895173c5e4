# Fig. 11: total energy dissipated.
name = 'figure_11'
load 'style.gp'
set logscale y
set format y '10^{%T}'
set xlabel 'frequency (Hz)'
set ylabel 'E_{tot} (J)'
set key title 'normal load' left
plot for [i=0:last] data index i using 1:2 with lines linewidth 2 dashtype 11 + i % 4 linecolor palette frac rank(i) title columnheader(1)
