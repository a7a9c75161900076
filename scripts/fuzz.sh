#!/usr/bin/env bash
# Runs every fuzzer of a build for some seconds, two at a time, and keeps what they found worth
# keeping: the fewest inputs that reach all the code that was reached, in tests/fuzz/corpus, which a
# test reads again. See tests/fuzz/CMakeLists.txt for the build.
#
#   scripts/fuzz.sh BUILD SECONDS [READER...]
set -euo pipefail
cd "$(dirname "$0")/.."
build=${1:?the folder of a build with EXEMPLAR_FUZZ=ON}
seconds=${2:?how long each fuzzer runs}
shift 2
readers=("$@")
if [ ${#readers[@]} -eq 0 ]; then
  for fuzzer in "$build"/tests/fuzz/*_fuzz; do
    name=$(basename "$fuzzer")
    readers+=("${name%_fuzz}")
  done
fi

fuzz() {
  local reader=$1 found="$build/corpus/$1" kept="tests/fuzz/corpus/$1"
  mkdir -p "$found" "$kept"
  # OpenVDB leaks what it has built of a grid when the file ends within it.
  local leaks=1
  [ "$reader" = vdb ] && leaks=0
  export ASAN_OPTIONS=detect_leaks=$leaks
  if ! "$build/tests/fuzz/${reader}_fuzz" -detect_leaks="$leaks" -timeout=60 -rss_limit_mb=3000 -max_len=8192 \
      -max_total_time="$seconds" -artifact_prefix="$build/crash-$reader-" \
      "$found" "$kept" > "$build/$reader.log" 2>&1; then
    echo "$reader: FAILED, see $build/$reader.log"
    return 1
  fi
  rm -rf "$kept.new"
  mkdir -p "$kept.new"
  "$build/tests/fuzz/${reader}_fuzz" -merge=1 -use_counters=0 -detect_leaks="$leaks" -timeout=60 -rss_limit_mb=3000 \
    "$kept.new" "$kept" "$found" > "$build/$reader.merge.log" 2>&1
  rm -rf "$kept"
  mv "$kept.new" "$kept"
  echo "$reader: $(grep -o 'Done [0-9]* runs' "$build/$reader.log" | tail -1)," \
    "$(find "$kept" -type f | wc -l) inputs kept"
}
export -f fuzz
export build seconds
printf '%s\n' "${readers[@]}" | xargs -P 2 -I{} bash -c 'fuzz {}'
