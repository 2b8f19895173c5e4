# The mesh of a sector of a bladed disk for CalculiX, 8-node bricks with incompatible modes:
#
#   awk -f mesh.awk > sector.inp                   # stores its matrices
#   awk -v cyclic=1 -f mesh.awk > cyclic.inp       # natural frequencies of the ring, for comparison
#
# A disk, clamped at its bore, and a blade in the middle of its rim, wider at its tip. m, N, kg, s; z: the axis.

function node(i, j, k) { return 1 + k + 2 * (j + (across + 1) * i) }
function is_there(i, j) { return i <= disk || (j >= 1 && j < across) || (i >= tip && j >= 0) }
function height(i) { return i <= disk ? 0.012 : 0.007 }
function radius(i) { return i <= disk ? bore + (rim - bore) * i / disk : rim + (top - rim) * (i - disk) / (tip + 1 - disk) }
# Of a blade, narrower than its part of the rim.
function angle(i, j) {
  middle = across / 2
  return pitch * ((i > disk ? (i >= tip ? 0.9 : 0.8) * rim / radius(i) : 1) * (j - middle) + middle) / across
}

BEGIN {
  sectors = 12; pitch = 8 * atan2(1, 1) / sectors
  across = 4; disk = 3; tip = 7                   # bricks around, and along the radius to the rim and to the tip
  bore = 0.04; rim = 0.12; top = 0.2

  print "*NODE, NSET=all"
  for (i = 0; i <= tip + 1; ++i)
    for (j = 0; j <= across; ++j)
      for (k = 0; k <= 1; ++k) {
        if (!is_there(i, j)) continue
        a = angle(i, j)
        printf "%d, %.12g, %.12g, %.12g\n", node(i, j, k), radius(i) * cos(a), radius(i) * sin(a), \
               (k - 0.5) * height(i)
        printf "node %d %.17g\n", node(i, j, k), a > "nodes.txt"
      }
  print "*ELEMENT, TYPE=C3D8I, ELSET=sector"
  for (i = 0; i <= tip; ++i)
    for (j = 0; j < across; ++j) {
      if (!is_there(i, j) || !is_there(i + 1, j) || !is_there(i, j + 1) || !is_there(i + 1, j + 1)) continue
      printf "%d", ++count
      for (k = 0; k <= 1; ++k)
        printf ", %d, %d, %d, %d", node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k), node(i, j + 1, k)
      print ""
    }
  print "*NSET, NSET=bore"
  for (j = 0; j <= across; ++j) print node(0, j, 0) ",\n" node(0, j, 1) ","
  print "*MATERIAL, NAME=steel\n*ELASTIC\n2.1e11, 0.3\n*DENSITY\n7850"
  print "*SOLID SECTION, ELSET=sector, MATERIAL=steel"
  print "*BOUNDARY\nbore, 1, 3"

  # Nodes that meet: of this sector, and of the face that is the next sector's.
  for (i = 1; i <= disk; ++i)
    for (k = 0; k <= 1; ++k) print "face", node(i, 0, k), node(i, across, k) > "nodes.txt"
  print "name left", node(tip + 1, 0, 1) > "nodes.txt"
  print "name right", node(tip + 1, across, 1) > "nodes.txt"
  print "name tip", node(tip + 1, across / 2, 1) > "nodes.txt"

  if (cyclic) {
    for (side = 0; side <= 1; ++side) {
      print "*SURFACE, NAME=" (side ? "second" : "first") ", TYPE=NODE"
      for (i = 1; i <= disk; ++i)
        for (k = 0; k <= 1; ++k) print node(i, side * across, k) ","
    }
    print "*TIE, NAME=ring, CYCLIC SYMMETRY\nfirst, second"
    print "*CYCLIC SYMMETRY MODEL, N=" sectors ", NGRAPH=1, TIE=ring\n0, 0, 0, 0, 0, 1"
    print "*STEP\n*FREQUENCY\n4\n*SELECT CYCLIC SYMMETRY MODES, NMIN=0, NMAX=" sectors / 2 "\n*END STEP"
  } else
    print "*STEP\n*FREQUENCY, SOLVER=MATRIXSTORAGE\n1\n*END STEP"
}
