#!/usr/bin/env bash
# peer.sh [OPTIONS] MESH...: Lozenge and MeshLab's "Iso Parametrization" on the same meshes and cores, one after the other; prints
# Markdown tables of what both gave and what it cost. `peer.sh --help` lists the options.
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
build=$here/../../build/release
range=100..200 runs=1 vertices=10000
skip_peer="" peer_figures="" keep="" meshes=()

help() {
  cat <<'HELP'
Usage: peer.sh [OPTIONS] MESH...

Meshes are .off, .obj, .ply or .stl, closed surfaces. What counts as seconds, on both sides, is all processes from the mesh in a file to
the map and a remesh in files: of Lozenge import, parameterize and sample, of MeshLab the filter and its remeshing.

  --range A..B          triangles of the domain [100..200]
  --runs N              of Lozenge; times are the median [1]
  --vertices N          about so many vertices in the remeshes [10000]
  --skip-peer           measure Lozenge alone
  --peer-figures FILE   take MeshLab's figures from here where FILE has them; else measure, and add them to it
  --build FOLDER        where Lozenge was built [build/release]
  --keep FOLDER         leave all files that were made here

`taskset --cpu-list 0,1 peer.sh ...` runs both on these cores.
HELP
}

fail() {
  echo "peer.sh: $*" >&2
  exit 2
}

say() { echo "peer.sh: $*" >&2; }

parse() {
  while (($#)); do
    case $1 in
      --range | --runs | --vertices | --peer-figures | --build | --keep) [[ -n ${2:-} ]] || fail "$1 wants a value" ;;&
      --range) range=$2 && shift ;;
      --runs) runs=$2 && shift ;;
      --vertices) vertices=$2 && shift ;;
      --peer-figures) peer_figures=$(realpath -m "$2") && shift ;;
      --build) build=$2 && shift ;;
      --keep) keep=$2 && shift ;;
      --skip-peer) skip_peer=yes ;;
      --help | -h) help && exit ;;
      -*) fail "there is no option $1; see --help" ;;
      *) meshes+=("$1") ;;
    esac
    shift
  done
  ((${#meshes[@]})) || fail "give a mesh; see --help"
  [[ $range =~ ^[0-9]+\.\.[0-9]+$ ]] || fail "--range wants two numbers: 100..200"
  [[ $runs =~ ^[1-9][0-9]*$ && $vertices =~ ^[1-9][0-9]*$ ]] || fail "--runs and --vertices want a number"
}

need() { command -v "$1" >/dev/null || fail "$1 is missing; on Debian: apt-get install $2"; }

# cost FILE COMMAND...: runs it, and leaves its seconds, processor's seconds and peak memory as JSON.
cost() {
  /usr/bin/time --quiet --format '{"seconds": %e, "user": %U, "system": %S, "peak_kb": %M}' --output "$1" "${@:2}" </dev/null >/dev/null
}

# Steps a side of a domain triangle for a remesh of about the wanted number of vertices: a domain of F triangles gets F/2 k^2.
rate_for() { awk -v f="$1" -v v="$vertices" 'BEGIN { k = int(sqrt(2 * v / f) + 0.5); print (k > 1 ? k : 1) }'; }

# The filter's samples a side of a half-diamond, of which a domain of F triangles has 3/2 F. It is asked before F is known.
peer_rate() {
  awk -v a="${range%..*}" -v b="${range#*..}" -v v="$vertices" 'BEGIN { print int(sqrt(v / (0.75 * (a + b))) + 1.5) }'
}

domain_of() { python3 -c 'import json, sys; print(json.load(open(sys.argv[1]))["domain"]["triangles"])' "$1"; }

# One line of JSON: {mesh, range, runs: [{import, parameterize, remesh}], report, table}
measure_ours() {
  local name=$1 glb=$2 folder=$3 run rate table costs=()
  for ((run = 1; run <= runs; ++run)); do
    cost "$folder/import.json" "$lozenge" import "$glb" -o "$folder/mesh.glb" --quiet || return
    cost "$folder/parameterize.json" "$lozenge" parameterize "$folder/mesh.glb" -o "$folder/map.glb" \
      --domain-faces "$range" --report "$folder/report.json" --quiet || return
    rate=$(rate_for "$(domain_of "$folder/report.json")")
    cost "$folder/remesh.json" "$lozenge" sample "$folder/map.glb" -o "$folder/remesh.glb" --quiet \
      --partition faces --rate "$rate" || return
    costs+=("{\"import\": $(<"$folder/import.json"), \"parameterize\": $(<"$folder/parameterize.json"), \"remesh\": $(<"$folder/remesh.json")}")
  done
  table=$("$mesh_table" "$folder/remesh.glb") || return
  printf '{"mesh": "%s", "range": "%s", "runs": [%s], "report": %s, "table": %s}\n' "$name" "$range" \
    "$(IFS=,; echo "${costs[*]}")" "$(tr '\n' ' ' <"$folder/report.json")" "$table"
}

# One line of JSON: {mesh, range, filter, table}
measure_peer() {
  local name=$1 off=$2 folder=$3 filter
  need meshlabserver meshlab
  need xvfb-run xvfb
  filter=$("$here/meshlab_filter.sh" "$off" "$folder" "${range%..*}" "${range#*..}" "$(peer_rate)")
  printf '{"mesh": "%s", "range": "%s", "filter": %s, "table": %s}\n' "$name" "$range" "$filter" \
    "$("$mesh_table" "$folder/remesh.ply" 2>/dev/null || echo null)"
}

# MeshLab's line, saved or measured now; nothing where it isn't wanted.
peer_line() {
  local name=$1 line=
  [[ -z $skip_peer ]] || return 0
  if [[ -n $peer_figures && -f $peer_figures ]]; then
    line=$(grep --fixed-strings "\"mesh\": \"$name\", \"range\": \"$range\"" "$peer_figures" | tail -n 1) || true
  fi
  if [[ -z $line ]]; then
    say "$name: MeshLab, which takes minutes"
    line=$(measure_peer "$@")
    [[ -z $peer_figures ]] || echo "$line" >>"$peer_figures"
  fi
  echo "$line"
}

compare() {
  local mesh=$1 name folder
  name=$(basename "$mesh")
  folder=$work/$name
  mkdir -p "$folder/ours" "$folder/peer"
  "$mesh_to_glb" "$mesh" "$folder/source.glb" || return 0
  # MeshLab gets the file as it is, where it can: another order of vertices changes what it finds.
  if [[ $mesh == *.off ]]; then
    cp "$mesh" "$folder/source.off"
  else
    "$mesh_to_glb" "$mesh" "$folder/source.off"
  fi
  say "$name: Lozenge"
  measure_ours "$name" "$folder/source.glb" "$folder/ours" >"$folder/ours.json" || {
    say "$name: Lozenge failed"
    return 0
  }
  peer_line "$name" "$folder/source.off" "$folder/peer" >"$folder/peer.json"
  python3 "$here/peer_table.py" "$folder/ours.json" "$folder/peer.json"
}

parse "$@"
lozenge=$build/lozenge mesh_to_glb=$build/tools/bench/mesh_to_glb mesh_table=$build/tools/bench/mesh_table
for program in "$lozenge" "$mesh_to_glb" "$mesh_table"; do
  [[ -x $program ]] || fail "$program is missing; run tools/dev build"
done
[[ -x /usr/bin/time ]] || fail "/usr/bin/time is missing; on Debian: apt-get install time"
if [[ -n $keep ]]; then
  work=$keep
else
  work=$(mktemp --directory)
  trap 'rm -rf "$work"' EXIT
fi
for mesh in "${meshes[@]}"; do
  [[ -f $mesh ]] || fail "$mesh: there is no such file"
  compare "$mesh"
done
