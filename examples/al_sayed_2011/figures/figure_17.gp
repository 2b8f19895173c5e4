# Fig. 17: forces per displacement at the peaks, in phase and out of phase.
name = 'figure_17'
load 'style.gp'
set logscale y
set format y '10^{%T}'
set xrange [0:100]
set yrange [1e-3:1e4]
set xlabel 'stick τ (%)'
set ylabel 'force per displacement (N/m)'
set key inside bottom center
plot data index 0 using 1:3 with lines linestyle 1 title 'F_{o/x}, fundamental', \
     data index 0 using 1:(abs($2)) with lines linestyle 3 title '|F_{p/x}|, fundamental', \
     data index 0 using 1:5 with lines linestyle 2 title 'F_{o/x}, largest values', \
     data index 0 using 1:(abs($4)) with lines linestyle 4 title '|F_{p/x}|, largest values'
