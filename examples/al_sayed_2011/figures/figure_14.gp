# Fig. 14: friction force, its cosine and sine parts, and displacement over the angle.
name = 'figure_14'
load 'style.gp'
set xrange [0:2*pi]
set xtics ('0' 0, 'π/2' pi/2, 'π' pi, '3π/2' 3*pi/2, '2π' 2*pi)
set xlabel 'angle θ = ωt'
set ylabel 'friction force (N)'
set y2label 'displacement (mm)'
set border 11
set yrange [-2:2]
set y2range [-1.2:1.2]
set ytics -2,1,2
set y2tics -1.2,0.6,1.2
set key outside top center horizontal
plot data index 0 using 1:3 with lines linestyle 9 title 'f_{nl}', \
     data index 0 using 1:4 with lines linestyle 3 title 'f_{nl cos}', \
     data index 0 using 1:5 with lines linestyle 2 title 'f_{nl sin}', \
     data index 0 using 1:(1000*$2) axes x1y2 with lines linestyle 1 title 'x', \
     data index 1 using 1:3 with points linestyle 11 title 'θ_0, θ*'
