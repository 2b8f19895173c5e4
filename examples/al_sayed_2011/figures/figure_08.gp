# Fig. 8: energy of friction in the three states of contact.
name = 'figure_08'
load 'style.gp'
set logscale y
set format y '10^{%T}'
set yrange [1e-5:0.1]
set xlabel 'frequency (Hz)'
set ylabel 'E_{friction} (J)'
set key title 'normal load' left
plot for [i=0:last] data index i using 1:($2 > 1e-12 ? $2 : 1e-12) with lines linestyle i+1 title columnheader(1)
