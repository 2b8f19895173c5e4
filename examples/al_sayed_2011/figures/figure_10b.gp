# Fig. 10b: energy of friction near full stick.
name = 'figure_10b'
load 'style.gp'
set yrange [0:0.05]
set xrange [20.85:20.95]
set xlabel 'frequency (Hz)'
set ylabel 'E_{friction} (J)'
set key title 'normal load' left
plot for [i=0:last] data index i using 1:2 with lines linestyle i+1 title columnheader(1)
