#!/bin/sh
# SPDX-License-Identifier: MIT
# Installs what is missing (Debian, Ubuntu), builds palpate and runs it: a hand presses on a slow tissue, with the
# held and with the predicted contact. Options are palpate's own.
set -eu
cd "$(dirname "$0")/.."

.ci/install g++=c++ cmake=cmake ninja-build=ninja gnuplot-nox=gnuplot \
  libeigen3-dev=/usr/include/eigen3/Eigen/Core libboost-dev=/usr/include/boost/hana.hpp \
  libcli11-dev=/usr/include/CLI/CLI.hpp nlohmann-json3-dev=/usr/include/nlohmann/json.hpp

export CMAKE_GENERATOR=Ninja
cmake --preset release -D LIMPID_BUILD_BENCH=OFF
cmake --build --preset release --target palpate

result=build/release/palpate
exec build/release/examples/palpate --json $result.json --csv $result.csv --plot $result.svg "$@"
