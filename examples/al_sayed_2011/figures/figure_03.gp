# Fig. 3: friction force over time, of one harmonic, of all and of the motion in time.
name = 'figure_03'
load 'style.gp'
set xlabel 'time (ms)'
set ylabel 'friction force (N)'
plot data index 0 using (1000*$2):3 with lines linestyle 9 title columnheader(1), \
     data index 1 using (1000*$2):3 with lines linestyle 1 title columnheader(1), \
     data index 2 using (1000*$2):3 with lines linestyle 2 title columnheader(1)
