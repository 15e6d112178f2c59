#!/bin/sh
# SPDX-License-Identifier: MIT
# bench/compile_time.sh [HEADER...]: what a source that includes only one public header takes the compiler (CXX, else
# g++; -O0 -std=c++20) in seconds of processor and megabytes at the peak, beside <Eigen/Dense> and <boost/hana.hpp>.
# All headers, or those named (limpid/core/time.hpp). Fails where limpid/limpid.hpp takes more than 3 times the seconds
# of <Eigen/Dense> or more than 1 GB, or where a header that is not for composition brings Hana.
set -eu
cd "$(dirname "$0")/.."
.ci/install g++=c++ time=/usr/bin/time libeigen3-dev=/usr/include/eigen3/Eigen/Core \
  libboost-dev=/usr/include/boost/hana.hpp

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 1' INT TERM

# Appends a line "seconds megabytes hana|- header": of some runs, the fastest, since others may be at work here.
measure() {
  printf '#include <%s>\n' "$1" > "$work/one.cpp"
  : > "$work/runs"
  run=0
  while [ $run -lt "$2" ]; do
    /usr/bin/time -f '%U %S %M' -o "$work/runs" -a "${CXX:-g++}" -std=c++20 -O0 -Iinclude \
      -isystem /usr/include/eigen3 -MD -MF "$work/one.d" -c "$work/one.cpp" -o "$work/one.o"
    run=$((run + 1))
  done
  hana=-
  ! grep -q '/boost/hana' "$work/one.d" || hana=hana
  awk -v hana=$hana -v header="$1" '
    { s = $1 + $2; if (NR == 1 || s < best) best = s; if ($3 > peak) peak = $3 }
    END { printf "%.2f %.0f %s %s\n", best, peak * 1024 / 1e6, hana, header }' "$work/runs" >> "$work/table"
}

for header in Eigen/Dense boost/hana.hpp limpid/limpid.hpp; do
  measure $header 3
done
if [ $# -eq 0 ]; then
  # shellcheck disable=SC2046
  set -- $(cd include && find limpid -name '*.hpp' ! -path '*/usb/*' ! -path limpid/limpid.hpp | sort)
fi
for header in "$@"; do
  measure "$header" 1
done

sort -k1,1nr -k4 "$work/table" | awk '
  BEGIN { printf "%8s %6s %6s  %s\n", "s", "MB", "Hana", "header" }
  { printf "%8s %6s %6s  %s\n", $1, $2, $3, $4 }
  $4 == "Eigen/Dense" { eigen = $1 }
  $4 == "limpid/limpid.hpp" { all = $1; peak = $2 }
  $3 == "hana" && $4 !~ /^(boost\/|limpid\/loop\/|limpid\/scene\/|limpid\/limpid\.hpp)/ { brings = brings " " $4 }
  END {
    printf "\nlimpid/limpid.hpp: %.2f times the seconds of <Eigen/Dense> (at most 3), %s MB (at most 1000)\n", all / eigen, peak
    if (brings) print "Hana, expected for composition alone, comes with" brings
    exit all > 3 * eigen || peak > 1000 || brings != ""
  }'
