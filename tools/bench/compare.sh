#!/usr/bin/env bash
# compare.sh OLD_BUILD NEW_BUILD [BENCHMARK_OPTION...]: times of two builds' parameterize_benchmark as a Markdown table
# (compare_benchmarks.py tells what its columns are). `compare.sh --help` lists the options.
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
rounds=3 keep="" builds=() options=()

help() {
  cat <<'HELP'
Usage: compare.sh [OPTIONS] OLD_BUILD NEW_BUILD [BENCHMARK_OPTION...]

The builds are folders such as build/release, of two worktrees. Both programs run in turn, so that what else the machine does
falls on both; each round measures everything twice.

  --rounds N      [3]
  --keep FOLDER   leave the measured times here, in old/ and new/, as JSON

BENCHMARK_OPTIONs are Google Benchmark's: --benchmark_filter=/smallest/ is the usual one, --benchmark_min_time=0.1 a quick one.
HELP
}

fail() {
  echo "compare.sh: $*" >&2
  exit 2
}

say() { echo "compare.sh: $*" >&2; }

parse() {
  while (($#)); do
    case $1 in
      --rounds | --keep) [[ -n ${2:-} ]] || fail "$1 wants a value" ;;&
      --rounds) rounds=$2 && shift ;;
      --keep) keep=$2 && shift ;;
      --help | -h) help && exit ;;
      --benchmark_*) options+=("$1") ;;
      -*) fail "there is no option $1; see --help" ;;
      *) builds+=("$1") ;;
    esac
    shift
  done
  ((${#builds[@]} == 2)) || fail "give two build folders; see --help"
  [[ $rounds =~ ^[1-9][0-9]*$ ]] || fail "--rounds wants a number"
}

# measure BUILD FILE
measure() {
  say "${2##*/} of $1"
  "$1/tools/bench/parameterize_benchmark" --benchmark_repetitions=2 "${options[@]}" --benchmark_out="$2" \
    --benchmark_out_format=json >/dev/null
}

parse "$@"
for build in "${builds[@]}"; do
  [[ -x $build/tools/bench/parameterize_benchmark ]] || fail "$build has no tools/bench/parameterize_benchmark; build it"
done
if [[ -z $keep ]]; then
  keep=$(mktemp --directory)
  trap 'rm -r "$keep"' EXIT
fi
mkdir -p "$keep/old" "$keep/new"
for ((round = 1; round <= rounds; ++round)); do
  measure "${builds[0]}" "$keep/old/round_$round.json"
  measure "${builds[1]}" "$keep/new/round_$round.json"
done
python3 "$here/compare_benchmarks.py" "$keep/old" "$keep/new"
