# Fig. 6c: amplitude of the peaks over the share of stick.
name = 'figure_06c'
load 'style.gp'
set logscale y
set format y '10^{%T}'
set xrange [0:100]
set yrange [5e-4:0.1]
set xlabel 'stick τ (%)'
set ylabel 'peak amplitude A_{max} (m)'
set key inside top center
plot data index 0 using 1:2 with lines linestyle 1 title 'curve of peaks', \
     data index last using 1:2 with points linestyle 10 title 'peaks of the responses in Fig. 6a', \
     data index 1 using 1:2 with points linestyle 11 title 'least peak'
