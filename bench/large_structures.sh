#!/bin/sh
# Cost over the size of a structure from matrix files: a cantilever of bricks with a friction damper at
# mid-span, order 5. Columns: rows, nonzero entries of one triangle, seconds of processor time to read and reduce,
# those of the frequency response after that, largest memory (MB).
#
#   bench/large_structures.sh build/release
set -eu
build=$1
folder=$(mktemp -d)
trap 'rm -r "$folder"' EXIT
cat > "$folder/scene.json" <<'SCENE'
{"format": "arcslip-scene-1",
 "structure": {"matrices": {"mass": "M.mtx", "stiffness": "K.mtx", "highest_frequency": 300}, "names": "names.csv",
               "damping": [{"name": "steel", "type": "rayleigh", "beta": 1e-5}]},
 "elements": [{"name": "damper", "type": "jenkins", "at": "mid", "stiffness": 1e5, "friction_coefficient": 0.5,
               "normal_load": 20}],
 "excitation": [{"name": "force", "at": "tip", "cosine": 10}],
 "harmonics": {"order": 5}, "response": {"at": "tip"},
 "studies": [{"kind": "frf", "from": 15, "to": 60}]}
SCENE
seconds() { # of a command, with its largest memory in kB
  /usr/bin/time -f '%U %S %M' "$@" 2>&1 > /dev/null | tail -n 1 | awk '{print $1 + $2, $3}'
}
printf '%10s %12s %16s %10s %10s\n' rows entries read_and_reduce frf memory
for mesh in '10 1 1' '40 2 2' '80 5 5' '120 10 9' '160 14 14'; do
  # shellcheck disable=SC2086
  "$build/bench/arcslip_cantilever_mesh" "$folder" $mesh
  rows=$(sed -n 2p "$folder/K.mtx")
  check=$(seconds "$build/app/arcslip" check "$folder/scene.json")
  frf=$(seconds "$build/app/arcslip" frf "$folder/scene.json")
  echo "$rows $check $frf" | awk '{printf "%10d %12d %16.2f %10.2f %10.0f\n", $1, $3, $4, $6 - $4, $7 / 1024}'
done
