# Matrix Market files in cylindrical coordinates, names and faces, from what CalculiX writes with SOLVER=MATRIXSTORAGE:
#
#   awk -f matrices.awk nodes.txt sector.dof sector.sti sector.mas
#
# makes sector_K.mtx, sector_M.mtx, names.csv and faces.csv: node.1, node.2, node.3 of sector.dof are x, y, z, and become
# r, t, z: along the radius, around, and along the axis. Entries that are 0 are left out.
FILENAME ~ /nodes/ {
  if ($1 == "node") { c[$2] = cos($3); s[$2] = sin($3) }
  if ($1 == "face") { own[++faces] = $2; beyond[faces] = $3 }
  if ($1 == "name") name[$3] = $2
  next
}
FILENAME ~ /\.dof$/ {
  split($1, at, "."); ++rows; node[rows] = at[1]; way[rows] = at[2]; row[at[1], at[2]] = rows
  if (at[1] in name) names = names name[at[1]] "." substr("rtz", at[2], 1) "," rows "\n"
  next
}
# Of a displacement along x or y, its share in that along r or t.
function share(r, to) {
  if (!(node[r] in c) || way[r] > 2) return to == way[r]
  if (to > 2) return 0
  return to == way[r] ? c[node[r]] : to == 1 ? s[node[r]] : -s[node[r]]
}
function add(which, i, j, value,   a, b, r, q) {
  for (a = 1; a <= 9; ++a) {
    if (!((node[i], a) in row) || share(i, a) == 0) continue
    for (b = 1; b <= 9; ++b) {
      if (!((node[j], b) in row) || share(j, b) == 0) continue
      r = row[node[i], a]; q = row[node[j], b]
      if (r >= q) entry[which, r, q] += share(i, a) * value * share(j, b)
    }
  }
}
{
  which = FILENAME ~ /\.sti$/ ? "K" : "M"
  add(which, $1, $2, $3)
  if ($1 != $2) add(which, $2, $1, $3)
}
END {
  for (place in entry) {
    split(place, key, SUBSEP)
    if (entry[place] != 0) ++count[key[1]]
  }
  for (m = 1; m <= 2; ++m) {
    which = substr("KM", m, 1); file = "sector_" which ".mtx"
    print "%%MatrixMarket matrix coordinate real symmetric\n" rows, rows, count[which] > file
    for (j = 1; j <= rows; ++j)
      for (i = j; i <= rows; ++i)
        if ((which, i, j) in entry && entry[which, i, j] != 0) printf "%d %d %.15g\n", i, j, entry[which, i, j] > file
  }
  printf "name,row\n%s", names > "names.csv"
  print "own,next" > "faces.csv"
  for (f = 1; f <= faces; ++f)
    for (a = 1; a <= 3; ++a) print row[own[f], a] "," row[beyond[f], a] > "faces.csv"
}
