# Fig. 15: friction force at the peaks, in phase and out of phase, over the share of stick.
name = 'figure_15'
load 'style.gp'
set logscale y
set format y '10^{%T}'
set xrange [0:100]
set yrange [1e-3:1e3]
set xlabel 'stick τ (%)'
set ylabel 'friction force at the peak (N)'
plot data index 0 using 1:4 with lines linestyle 9 title 'force, fundamental', \
     data index 0 using 1:2 with lines linestyle 1 title 'in phase, fundamental', \
     data index 0 using 1:3 with lines linestyle 3 title 'out of phase, fundamental', \
     data index 0 using 1:7 with lines linestyle 4 title '||f_{nl}||', \
     data index 0 using 1:5 with lines linestyle 1 dashtype (14,5) linewidth 1.5 title 'F_{nl sin}', \
     data index 0 using 1:6 with lines linestyle 3 dashtype (14,5) linewidth 1.5 title 'F_{nl cos}'
