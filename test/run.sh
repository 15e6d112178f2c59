#!/bin/sh
# SPDX-License-Identifier: MIT
# Installs what is missing (Debian, Ubuntu), builds limpid with its tests and examples, sees that the benchmarks compile,
# and runs all tests.
# --long: then runs a minute of each fuzz target (clang), what counts under the sanitizers, and the stress programs for
# 1e8 ticks.
set -eu
cd "$(dirname "$0")/.."

long=
case "$*" in
  '') ;;
  --long) long=yes ;;
  *)
    echo "test/run.sh [--long], got: $*" >&2
    exit 2
    ;;
esac

.ci/install g++=c++ cmake=cmake ninja-build=ninja gnuplot-nox=gnuplot \
  libeigen3-dev=/usr/include/eigen3/Eigen/Core libboost-dev=/usr/include/boost/hana.hpp \
  doctest-dev=/usr/include/doctest/doctest.h libbenchmark-dev=/usr/include/benchmark/benchmark.h \
  libcli11-dev=/usr/include/CLI/CLI.hpp nlohmann-json3-dev=/usr/include/nlohmann/json.hpp \
  coinor-csdp=csdp
# Of devices on USB, which nothing else needs.
.ci/install pkg-config=pkg-config libusb-1.0-0-dev=/usr/include/libusb-1.0/libusb.h \
  libumockdev-dev=/usr/include/umockdev-1.0/umockdev.h || echo "Without these the tests of devices on USB are left out"

export CMAKE_GENERATOR=Ninja
CTEST_PARALLEL_LEVEL=$(nproc)
CMAKE_BUILD_PARALLEL_LEVEL=${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}  # ninja's own, two more, takes 5 GB more at the peak
export CTEST_PARALLEL_LEVEL CMAKE_BUILD_PARALLEL_LEVEL
[ -n "$long" ] || exec cmake --workflow --preset dev

cmake --workflow --preset dev
.ci/install clang=clang++
.ci/install "libclang-rt-dev=$(clang++ -print-runtime-dir)/libclang_rt.fuzzer-$(uname -m).a"
cmake --preset dev -B build/fuzz -DCMAKE_CXX_COMPILER=clang++ -DLIMPID_BUILD_FUZZ=ON \
  -DLIMPID_BUILD_EXAMPLES=OFF -DLIMPID_BUILD_BENCH=OFF
cmake --build build/fuzz --target limpid_fuzz
ctest --test-dir build/fuzz --label-regex '^fuzz$' --output-on-failure --no-tests=error

# The numerical core and its stress under the address and undefined behaviour sanitizers; of the thread sanitizer's, the
# two parts with threads. All tests under either: cmake --workflow --preset asan, or tsan. Clang compiles the first in half
# the time and memory; its thread sanitizer does not let a program count allocations.
cmake --preset asan -DCMAKE_CXX_COMPILER=clang++ -DLIMPID_BUILD_EXAMPLES=OFF
cmake --build --preset asan --target limpid_test_core limpid_test_signal limpid_test_estimation \
  limpid_test_prediction limpid_test_robot limpid_test_control limpid_test_loop limpid_test_stress
ctest --preset asan --tests-regex '^(core|signal|estimation|prediction|robot|control|loop|stress)[.]'
cmake --preset tsan -DLIMPID_BUILD_EXAMPLES=OFF
cmake --build --preset tsan --target limpid_test_design limpid_test_loop
ctest --preset tsan --tests-regex '^(design[.]map$|loop[.])'

cmake --preset release
cmake --build --preset release --target stress
build/release/bench/stress
