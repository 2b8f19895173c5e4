# Fig. 6b: share of the period in stick.
name = 'figure_06b'
load 'style.gp'
set xlabel 'frequency (Hz)'
set ylabel 'stick τ (%)'
set yrange [0:102]
set key title 'normal load' left
plot for [i=0:last] data index i using 1:2 with lines linewidth 2 dashtype 11 + i % 4 linecolor palette frac rank(i) title columnheader(1)
