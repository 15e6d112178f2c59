#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Instructions of one whole tick in each form, by callgrind: the difference of two runs of different length.
# usage: bench/instructions.sh [FOLDER OF BENCH PROGRAMS, default build/release/bench]
set -euo pipefail
programs=${1:-"$(cd "$(dirname "$0")/.." && pwd)/build/release/bench"}
command -v valgrind >/dev/null || { echo "valgrind is not installed (Debian: valgrind)"; exit 1; }

count() {
  valgrind --tool=callgrind --callgrind-out-file=/dev/null "$programs/tick" once "$1" "$2" 2>&1 |
    sed -n 's/.*Collected : \([0-9]*\).*/\1/p'
}

few=2000
many=4000
empty=0
printf '%-24s %s\n' form 'instructions a tick'
for form in empty composed hand_written composed_with_safety hand_written_with_safety composed_float straightforward; do
  tick=$((($(count $form $many) - $(count $form $few)) / (many - few)))
  [ $form = empty ] && empty=$tick
  printf '%-24s %d\n' $form $((tick - empty))
done
