# Fig. 7: shape of the loop in the three states of contact.
name = 'figure_07'
load 'style.gp'
set xlabel 'displacement x/A_{max}'
set ylabel 'friction force f_{nl}/({/Symbol m}F_n)'
set yrange [-1.1:1.1]
set xrange [-1.05:1.05]
set key title 'normal load' left
plot for [i=0:last] data index i using 1:2 with lines linestyle i+1 title columnheader(1)
