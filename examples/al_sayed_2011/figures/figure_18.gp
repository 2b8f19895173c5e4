# Fig. 18: parts of the out-of-phase force per displacement.
name = 'figure_18'
load 'style.gp'
set logscale y
set format y '10^{%T}'
set xrange [0:100]
set yrange [1:1e4]
set xlabel 'stick τ (%)'
set ylabel 'force per displacement (N/m)'
set key inside bottom center
plot data index 0 using 1:2 with lines linestyle 1 title 'contact, fundamental', \
     data index 0 using 1:3 with lines linestyle 3 title 'viscous', \
     data index 0 using 1:4 with lines linestyle 2 title 'F_{nl cos}/A_{max}'
