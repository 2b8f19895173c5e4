# What all figures have in common. A script sets `name` and loads this. Before it may be set
#   format   'svg' or 'png' (the default)
#   width    of a PNG, in pixels
if (!exists('format')) format = 'png'
if (!exists('width')) width = 1600
data = name.'.dat'
set encoding utf8
if (format eq 'svg') {
  set terminal svg size 800,500 font 'Helvetica,15' background rgb 'white' dashlength 0.5
} else {
  set terminal pngcairo size width,width*5/8 font 'Sans,15' fontscale width/1000. linewidth width/800. pointscale width/800. dashlength 0.5
}
set output name.'.'.format

set border 3 back linewidth 1 linecolor rgb '#333333'
set tics nomirror out scale 0.8,0.4
set grid xtics ytics back linetype 1 linewidth 0.5 linecolor rgb '#dddddd'
set key outside right center vertical Left reverse samplen 3.5 spacing 1.3 width 1

# A few curves, distinguished by colour and by dash.
set style line 1 linewidth 2.5 linecolor rgb '#0d0887' dashtype solid
set style line 2 linewidth 2.5 linecolor rgb '#b93289' dashtype (14,5)
set style line 3 linewidth 2.5 linecolor rgb '#e28a18' dashtype (4,4)
set style line 4 linewidth 2.5 linecolor rgb '#555555' dashtype (14,4,3,4)
# A broad one, for what others are laid upon; marks.
set style line 9 linewidth 8 linecolor rgb '#cccccc' dashtype solid
set style line 10 linewidth 1.5 linecolor rgb '#0d0887' pointtype 7 pointsize 0.8
set style line 11 linewidth 2 linecolor rgb '#222222' pointtype 6 pointsize 1.6

# A family of curves: colours in the order of the parameter, neighbours distinguished by dash.
set palette defined (0 '#0d0887', 1 '#5402a3', 2 '#8b0aa5', 3 '#b93289', 4 '#db5c68', 5 '#e47048', 6 '#e28a18')
set cbrange [0:1]
unset colorbox
set dashtype 11 (1,0)
set dashtype 12 (14,5)
set dashtype 13 (4,4)
set dashtype 14 (14,4,3,4)
stats data using 1 nooutput
last = STATS_blocks - 1
rank(i) = last > 0 ? real(i)/last : 0
