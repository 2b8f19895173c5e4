# The mesh of the blade for CalculiX, 8-node bricks with incompatible modes:
#
#   awk -f mesh.awk > blade.inp
#
# A shank, clamped at its root, a platform, and above it a twisted and tapered airfoil.
# m, N, kg, s; x: axial, y: tangential, z: radial.

function node(i, j, k) { return 2 + k + (thick + 3) * (j + (chord + 1) * i) }

function radius(i) {
  return i < platform ? lower * i / (platform - 1) : upper + (top - upper) * (i - platform) / (span - platform)
}

BEGIN {
  span = 10; chord = 3; thick = 1                            # bricks
  platform = 5; lower = 0.074; upper = 0.080; overhang = 0.02  # brick of the span, its radii, its width at the sides
  top = 0.2; width = 0.06; twist = 30                        # of the airfoil, degrees
  turn = twist * atan2(0, -1) / 180

  print "*NODE, NSET=all"
  for (i = 0; i <= span; ++i)
    for (j = 0; j <= chord; ++j)
      for (k = -1; k <= thick + 1; ++k) {
        side = k < 0 ? -1 : k > thick ? 1 : 0
        if (side && i != platform && i != platform - 1) continue
        z = radius(i); above = z > upper ? (z - upper) / (top - upper) : 0
        c = j / chord - 0.5
        x = width * c
        y = (0.009 - 0.006 * above) * (1 - 2 * c * c) * ((k - side) / thick - 0.5)
        printf "%d, %.9g, %.9g, %.9g\n", node(i, j, k), x * cos(turn * above) - y * sin(turn * above), \
               x * sin(turn * above) + y * cos(turn * above) + side * overhang, z
      }

  print "*ELEMENT, TYPE=C3D8I, ELSET=blade"
  for (i = 0; i < span; ++i)
    for (j = 0; j < chord; ++j)
      for (k = -1; k <= thick; ++k) {
        if ((k < 0 || k == thick) && i != platform - 1) continue
        printf "%d", ++count
        for (di = 0; di <= 1; ++di)
          printf ", %d, %d, %d, %d", node(i + di, j, k), node(i + di, j + 1, k), \
                 node(i + di, j + 1, k + 1), node(i + di, j, k + 1)
        print ""
      }

  print "*NSET, NSET=root"
  for (j = 0; j <= chord; ++j)
    for (k = 0; k <= thick; ++k) print node(0, j, k) ","
  print "*MATERIAL, NAME=steel\n*ELASTIC\n2.1e11, 0.3\n*DENSITY\n7850"
  print "*SOLID SECTION, ELSET=blade, MATERIAL=steel"
  print "*BOUNDARY\nroot, 1, 3"
  print "*STEP\n*FREQUENCY, SOLVER=MATRIXSTORAGE\n10\n*END STEP"

  # The lower edge of the platform on the suction side, and the tip.
  print "front", node(platform - 1, 0, thick + 1) > "nodes.txt"
  print "rear", node(platform - 1, chord, thick + 1) > "nodes.txt"
  print "tip", node(span, 1, thick) > "nodes.txt"
}
