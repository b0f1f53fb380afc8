#!/usr/bin/env bash
# robustness.sh [OPTIONS] [OUT.md]: `lozenge build` with its defaults over all meshes of Debian's package libcgal-demo, sound or
# not; a Markdown table of what became of each, on standard output or in OUT.md. `robustness.sh --help` lists the options.
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
build=$here/../../build/release
jobs=1 limit=120 only=. meshes="" out=/dev/stdout

help() {
  cat <<'HELP'
Usage: robustness.sh [OPTIONS] [OUT.md]

A mesh that Lozenge refuses is a row of the table like any other. `check` is the exit code of `lozenge check` over all outputs; `mean` and
`boundary` are the mean distance and the largest one along boundaries, in percent of the box diagonal.

  --jobs J          meshes at once [1]; seconds are only worth something with 1
  --limit SECONDS   most that a mesh may take [120]; exit code 124 says that it was not enough
  --only REGEX      only files whose name matches
  --meshes FOLDER   these meshes (.off, .obj, .ply, .stl, .glb) instead of the package's
  --build FOLDER    where Lozenge was built [build/release]

Without --meshes the package's files are taken from where it is installed, else it is downloaded (24 MB) and unpacked aside.
HELP
}

fail() {
  echo "robustness.sh: $*" >&2
  exit 2
}

parse() {
  while (($#)); do
    case $1 in
      --jobs | --limit | --only | --meshes | --build) [[ -n ${2:-} ]] || fail "$1 wants a value" ;;&
      --jobs) jobs=$2 && shift ;;
      --limit) limit=$2 && shift ;;
      --only) only=$2 && shift ;;
      --meshes) meshes=$(realpath "$2") && shift ;;
      --build) build=$2 && shift ;;
      --help | -h) help && exit ;;
      -*) fail "there is no option $1; see --help" ;;
      *) out=$1 ;;
    esac
    shift
  done
  [[ $jobs =~ ^[1-9][0-9]*$ && $limit =~ ^[1-9][0-9]*$ ]] || fail "--jobs and --limit want a number"
}

# Unpacks the package's data; leaves the folder in `meshes`.
fetch_meshes() {
  local data=/usr/share/doc/libcgal-dev/data.tar.gz
  if [[ ! -f $data ]]; then
    echo "robustness.sh: downloading libcgal-demo" >&2
    (cd "$work" && apt-get --quiet --quiet download libcgal-demo 2>/dev/null) ||
      fail "libcgal-demo can't be downloaded; install it, or give --meshes"
    dpkg-deb --extract "$work"/libcgal-demo_*.deb "$work/package"
    data=$work/package$data
  fi
  tar --extract --gzip --file "$data" --directory "$work"
  meshes=$work/data/meshes
}

# figures REPORT: triangles read, domain triangles, distortion, distances and repairs, as cells.
figures() {
  python3 - "$1" <<'PYTHON'
import json, sys

report = json.load(open(sys.argv[1]))
distortion, asset = report["distortion"], report["asset"]
boundary = asset.get("boundary_max_distance_percent")
repairs = report.get("repairs") or {}
print(report["source"]["triangles"], report["domain"]["triangles"],
      *(f"{distortion[key]:.4f}" for key in ("area", "angle", "aggregate")), distortion["folded_triangles"],
      f"{asset['mean_distance_percent']:.4f}", "–" if boundary is None else f"{boundary:.3f}",
      ", ".join(f"{name.replace('_', ' ')} {repair['count']}" for name, repair in repairs.items()), sep=" | ")
PYTHON
}

# The first line of a log that says what is wrong, fit for a cell.
message() { sed 's/^mesh_to_glb: //; s/^lozenge build: mesh\.glb: //' "$1" | head -n 1 | tr '|' '/' | cut --characters -200; }

# convert MESH GLB
convert() {
  case $1 in
    *.glb) cp "$1" "$2" ;;
    *) "$mesh_to_glb" "$1" "$2" ;;
  esac
}

# row MESH: its line of the table.
row() {
  local mesh=$1 name folder code=0 started seconds check=– cells='– | – | – | – | – | – | – | – | '
  name=${mesh#"$meshes"/}
  folder=$work/${name//\//_}
  mkdir -p "$folder/out"
  started=$EPOCHREALTIME
  convert "$mesh" "$folder/mesh.glb" 2>"$folder/log" || code=$?
  if ((code == 0)); then
    started=$EPOCHREALTIME
    timeout "$limit" "$lozenge" build "$folder/mesh.glb" -o "$folder/out" --report "$folder/report.json" --quiet \
      >/dev/null 2>"$folder/log" </dev/null || code=$?
  fi
  seconds=$(awk -v a="$started" -v b="$EPOCHREALTIME" 'BEGIN { printf "%.1f", b - a }')
  if ((code == 0)); then
    check=0
    "$lozenge" check "$folder"/out/mesh.{glb,gim.exr,gim.json,normal.png,occlusion.png} --quiet >/dev/null 2>"$folder/log" || check=$?
    cells=$(figures "$folder/report.json")
  fi
  echo "| $name | $code | $check | $seconds | $cells | $(message "$folder/log") |"
  rm -rf "$folder"
  echo "$name: exit code $code, $seconds s" >&2
}

# What the table says, in one line.
summary() {
  awk -F ' *[|] *' '/\.(off|obj|ply|stl|glb) / { n++; codes[$3]++; if ($4 != "0" && $3 == 0) unsound++; folded += $11 }
    END { printf "%d meshes", n; for (c = 0; c < 256; c++) if (c in codes) printf ", %d with exit code %d", codes[c], c
          printf "; %d results that `lozenge check` refuses, %d folded triangles\n", unsound, folded }' "$1"
}

parse "$@"
lozenge=$build/lozenge mesh_to_glb=$build/tools/bench/mesh_to_glb
for program in "$lozenge" "$mesh_to_glb"; do
  [[ -x $program ]] || fail "$program is missing; run tools/dev build"
done
work=$(mktemp --directory)
trap 'rm -rf "$work"' EXIT
[[ -n $meshes ]] || fetch_meshes
export work meshes limit lozenge mesh_to_glb
export -f row convert figures message

{
  echo '| file | exit code | check | seconds | triangles | domain | area | angle | aggregate | folded | mean % | boundary % | repairs | message |'
  echo '|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---|---|'
  # shellcheck disable=SC2016 # the inner shell expands it
  find "$meshes" -maxdepth 2 -type f -regex '.*\.\(off\|obj\|ply\|stl\|glb\)' -printf '%P\n' | grep --extended-regexp "$only" | sort |
    sed "s|^|$meshes/|" | tr '\n' '\0' |
    xargs --null --max-args 1 --max-procs "$jobs" bash -c 'row "$1"' row |
    sort
} >"$work/table.md"
{
  summary "$work/table.md"
  echo
  cat "$work/table.md"
} >"$work/result.md"
cat "$work/result.md" >"$out"
