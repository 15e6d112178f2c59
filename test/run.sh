#!/bin/sh
# SPDX-License-Identifier: MIT
# Installs what is missing (Debian, Ubuntu), builds limpid with its examples and benchmarks, and runs all tests.
set -eu
cd "$(dirname "$0")/.."

.ci/install g++=c++ cmake=cmake ninja-build=ninja gnuplot-nox=gnuplot \
  libeigen3-dev=/usr/include/eigen3/Eigen/Core libboost-dev=/usr/include/boost/hana.hpp \
  doctest-dev=/usr/include/doctest/doctest.h libbenchmark-dev=/usr/include/benchmark/benchmark.h \
  libcli11-dev=/usr/include/CLI/CLI.hpp nlohmann-json3-dev=/usr/include/nlohmann/json.hpp \
  coinor-csdp=csdp

export CMAKE_GENERATOR=Ninja
CTEST_PARALLEL_LEVEL=$(nproc)
export CTEST_PARALLEL_LEVEL
exec cmake --workflow --preset dev
