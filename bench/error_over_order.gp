# gnuplot -c bench/error_over_order.gp error_over_order.csv docs/figures/error_over_order.png
set terminal pngcairo size 2000, 1100 font "DejaVu Sans,15"
set output ARG2
set datafile separator ","
set logscale xy
set xrange [0.9:230]
set yrange [1e-13:1]
set format y "10^{%T}"
set ytics 100
set xtics (1, 3, 7, 15, 27, 55, 101, 201)
set grid lc rgb "#dddddd"
set key bottom left
set multiplot layout 2, 3 margins 0.06, 0.985, 0.08, 0.95 spacing 0.05, 0.09
of(name, samples) = "< awk -F, '$1 == \"".name."\" && $2 == ".samples."' ".ARG1
exact(name) = of(name, 0)
slope(n, c, power) = c * n**power

do for [name in "'jenkins' 'gap_spring' 'contact_2d' 'contact_3d closed' 'contact_3d'"] {
  set title (name eq "contact_3d" || name eq "contact_2d" ? name.", opening" : \
             name eq "contact_3d closed" ? "contact_3d, closed" : name) noenhanced
  set xlabel (name[1:10] eq "contact_3d" ? "order N" : "")
  set ylabel (name eq "jenkins" || name eq "contact_3d closed" ? "relative error of the amplitude" : "")
  plot of(name, 512) using 3:4 with linespoints lw 2 pt 6 lc rgb "#d55e00" title "512 samples", \
       of(name, 4096) using 3:4 with linespoints lw 2 pt 4 lc rgb "#cc79a7" title "4096 samples", \
       exact(name) using 3:4 with linespoints lw 2 pt 7 lc rgb "#0072b2" title "exact integrals", \
       slope(x, 0.1, -3) with lines dt 4 lc rgb "#888888" title "N^{-3}"
}
set title "iwan"
set key top right
set xlabel "order N"
set ylabel ""
plot of("iwan table", 512) using 3:4 with linespoints lw 2 pt 6 lc rgb "#d55e00" title "table, 512 samples", \
     of("iwan table", 4096) using 3:4 with linespoints lw 2 pt 4 lc rgb "#cc79a7" title "table, 4096 samples", \
     exact("iwan table") using 3:4 with linespoints lw 2 pt 7 lc rgb "#0072b2" title "table, exact integrals", \
     exact("iwan") using 3:4 with linespoints lw 2 pt 5 lc rgb "#009e73" title "uniform, exact integrals", \
     slope(x, 0.1, -3) with lines dt 4 lc rgb "#888888" title "N^{-3}", \
     slope(x, 0.01, -4) with lines dt 3 lc rgb "#888888" title "N^{-4}"
unset multiplot
