# Fig. 19: amplitude, energy of friction and out-of-phase force, each over its value at the least peak.
name = 'figure_19'
load 'style.gp'
stats data index 2 using 2 nooutput name 'A'
stats data index 2 using 3 nooutput name 'E'
stats data index 2 using 4 nooutput name 'F'
set logscale y
set format y '10^{%T}'
set xrange [0:100]
set yrange [0.01:100]
set xlabel 'stick τ (%)'
set ylabel 'over the value at the least peak'
set arrow from 50,graph 0 to 50,graph 1 nohead linewidth 1 dashtype (4,4) linecolor rgb '#888888'
set key inside top center opaque
plot data index 0 using 1:($2/A_max) with lines linestyle 1 title 'A_{max}', \
     data index 0 using 1:($3 > 1e-12 ? $3/E_max : 1e-12) with lines linestyle 2 title 'E_{friction}', \
     data index 0 using 1:($4/F_max) with lines linestyle 3 title 'F_{o/x}'
