# Fig. 5: error of the force of one harmonic over the load, at the resonance peaks, in three norms.
name = 'figure_05'
load 'style.gp'
set logscale x
set format x '10^{%T}'
set xlabel 'normal load (N)'
set ylabel 'error of one harmonic (%)'
set yrange [0:50]
set key inside top right
plot data index 0 using 1:3 with lines linestyle 1 title 'of the largest force', \
     data index 1 using 1:3 with points linestyle 10 notitle, \
     data index 0 using 1:4 with lines linestyle 2 title 'in the root mean square'
