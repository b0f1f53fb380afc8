#!/usr/bin/env bash
# meshlab_filter.sh MESH.off OUT_FOLDER MIN MAX RATE: MeshLab's "Iso Parametrization", measured.
#
# Runs the filter with the best heuristic between MIN and MAX domain triangles, then its remeshing with RATE samples a side, as
# one process without a display. Prints one line of JSON: {domain, area, angle, seconds, user, system, peak_kb}, where it failed with `failed` for the first three.
# In OUT_FOLDER stay remesh.ply (as OFF it would name vertices that aren't there), and all that MeshLab said. The exit code is 0 where the filter could be run at all.
#
# Wants Debian's packages meshlab, xvfb and time. LIMIT is the most seconds that it may take (900).
set -euo pipefail

mesh=$1 folder=$2 min=$3 max=$4 rate=$5
limit=${LIMIT:-900}
mkdir -p "$folder"

write_script() {
  cat <<XML
<!DOCTYPE FilterScript>
<FilterScript>
  <filter name="Iso Parametrization: Main">
    <Param name="targetAbstractMinFaceNum" type="RichInt" value="$min"/>
    <Param name="targetAbstractMaxFaceNum" type="RichInt" value="$max"/>
    <Param name="stopCriteria" type="RichEnum" value="0" enum_cardinality="4" enum_val0="Best Heuristic" enum_val1="Area + Angle" enum_val2="Regularity" enum_val3="L2"/>
    <Param name="convergenceSpeed" type="RichInt" value="1"/>
    <Param name="DoubleStep" type="RichBool" value="true"/>
    <Param name="AbsLoadName" type="RichString" value=""/>
    <Param name="AbsSaveName" type="RichString" value=""/>
  </filter>
  <filter name="Iso Parametrization Remeshing">
    <Param name="SamplingRate" type="RichInt" value="$rate"/>
  </filter>
</FilterScript>
XML
}

# The figures of the domain that it chose: those that it reports last.
figures() {
  tr '\n' ' ' <"$folder/said.txt" | sed --quiet --regexp-extended \
    's/.*ABSTRACT DOMAIN faces: *([0-9]+) *AREA *distorsion: *([-+.0-9e]+) *; *ANGLE *distorsion: *([-+.0-9e]+).*/"domain": \1, "area": \2, "angle": \3/p'
}

write_script >"$folder/script.mlx"
status=0
/usr/bin/time --quiet --format '"seconds": %e, "user": %U, "system": %S, "peak_kb": %M' --output "$folder/cost.txt" \
  timeout "$limit" xvfb-run --auto-servernum meshlabserver -i "$mesh" -s "$folder/script.mlx" -o "$folder/remesh.ply" \
  >"$folder/said.txt" 2>"$folder/complained.txt" </dev/null &
measured=$!
# `timeout` and what it runs are a group of their own, which no signal to us reaches.
trap 'pkill --parent "$measured"; exit 130' INT TERM
wait "$measured" || status=$?

found=$(figures)
if [[ $status -eq 124 ]]; then
  found='"failed": "took longer than '$limit' seconds"'
elif [[ $status -ne 0 ]]; then
  # It can give up a map whose figures it has told.
  found="\"failed\": \"exit code $status${found:+, after ${found//[\":]/}}\""
elif [[ -z $found ]]; then
  found='"failed": "printed no figures"'
fi
echo "{$found, $(tail -n 1 "$folder/cost.txt")}"
