# Fig. 12: energies at the resonance peaks over the share of stick.
name = 'figure_12'
load 'style.gp'
set logscale y
set format y '10^{%T}'
set yrange [1e-5:1]
set xrange [0:100]
set xlabel 'stick τ (%)'
set ylabel 'energy per period at the peak (J)'
set key inside top center
plot data using 1:4 with lines linestyle 9 title 'E_{tot}', \
     data using 1:($2 > 1e-12 ? $2 : 1e-12) with lines linestyle 1 title 'E_{friction}', \
     data using 1:3 with lines linestyle 2 title 'E_{viscous}'
