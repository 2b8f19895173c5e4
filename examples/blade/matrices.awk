# Matrix Market files, and the rows of named nodes, from what CalculiX writes with SOLVER=MATRIXSTORAGE:
#
#   awk -f matrices.awk nodes.txt blade.dof blade.sti blade.mas
#
# makes blade_K.mtx, blade_M.mtx and names.csv: node.1, node.2, node.3 of blade.dof are x, y, z. Entries that are 0 are left out.
FILENAME ~ /nodes/ { name[$2] = $1; next }
FILENAME ~ /\.dof$/ {
  ++rows; split($1, at, ".")
  if (at[1] in name) names = names name[at[1]] "." substr("xyz", at[2], 1) "," rows "\n"
  next
}
$3 != 0 {
  which = FILENAME ~ /\.sti$/ ? "K" : "M"
  text[which] = text[which] sprintf("%d %d %.13g\n", $2, $1, $3); ++count[which]
}
END {
  for (which in text) {
    file = "blade_" which ".mtx"
    print "%%MatrixMarket matrix coordinate real symmetric\n" rows, rows, count[which] > file
    printf "%s", text[which] > file
  }
  printf "name,row\n%s", names > "names.csv"
}
