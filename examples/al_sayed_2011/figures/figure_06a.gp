# Fig. 6a: frequency responses.
name = 'figure_06a'
load 'style.gp'
set logscale y
set format y '10^{%T}'
set xlabel 'frequency (Hz)'
set ylabel 'amplitude (m)'
set key title 'normal load' left
plot for [i=0:last] data index i using 1:2 with lines linewidth 2 dashtype 11 + i % 4 linecolor palette frac rank(i) title columnheader(1)
