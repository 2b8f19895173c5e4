# Fig. 4: hysteresis loops, of one harmonic, of all and of the motion in time.
name = 'figure_04'
load 'style.gp'
set xlabel 'displacement (mm)'
set ylabel 'friction force (N)'
plot data index 0 using (1000*$1):2 with lines linestyle 9 title columnheader(1), \
     data index 1 using (1000*$1):2 with lines linestyle 1 title columnheader(1), \
     data index 2 using (1000*$1):2 with lines linestyle 2 title columnheader(1)
