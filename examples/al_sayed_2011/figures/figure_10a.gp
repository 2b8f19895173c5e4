# Fig. 10a: energy of friction.
name = 'figure_10a'
load 'style.gp'
set logscale y
set format y '10^{%T}'
set yrange [1e-6:0.1]
set xlabel 'frequency (Hz)'
set ylabel 'E_{friction} (J)'
set key title 'normal load' left
plot for [i=0:last] data index i using 1:($2 > 1e-12 ? $2 : 1e-12) with lines linewidth 2 dashtype 11 + i % 4 linecolor palette frac rank(i) title columnheader(1)
