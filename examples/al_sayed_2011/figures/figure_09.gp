# Fig. 9: amplitude in the three states of contact.
name = 'figure_09'
load 'style.gp'
set logscale y
set format y '10^{%T}'
set xlabel 'frequency (Hz)'
set ylabel 'amplitude (m)'
set key title 'normal load' left
plot for [i=0:last] data index i using 1:2 with lines linestyle i+1 title columnheader(1)
