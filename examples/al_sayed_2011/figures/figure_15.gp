# Fig. 15: friction force at the peaks, in phase and out of phase, over the share of stick: of the fundamental, and by
# the largest values over the period.
name = 'figure_15'
load 'style.gp'
set logscale y
set format y '10^{%T}'
set xrange [0:100]
set yrange [1e-3:1e3]
set xlabel 'stick τ (%)'
set key inside top left width 0
set multiplot layout 1,2
set ylabel 'friction force at the peak (N)'
set title 'fundamental'
plot data index 0 using 1:4 with lines linestyle 9 title 'force', \
     data index 0 using 1:2 with lines linestyle 1 title 'in phase', \
     data index 0 using 1:($3 > 1e-12 ? $3 : 1e-12) with lines linestyle 3 title 'out of phase'
unset ylabel
set title 'largest values over the period'
plot data index 0 using 1:7 with lines linestyle 9 title '||f_{nl}||', \
     data index 0 using 1:5 with lines linestyle 1 title 'F_{nl sin}', \
     data index 0 using 1:6 with lines linestyle 3 title 'F_{nl cos}'
unset multiplot
