// SPDX-License-Identifier: MIT
// Blocks given in any order; the compiler orders them and leaves out what nobody wants.
#include <limpid/loop/diagram.hpp>
#include <limpid/loop/loop.hpp>

#include <cstdio>

using namespace limpid;

struct Force {
  using value_type = double;  // N
};
struct Depth {
  using value_type = double;  // m
};
struct Torque {
  using value_type = double;  // N m
};
struct Temperature {
  using value_type = double;  // degrees
};

int main() {
  auto drive = make_block<struct Drive, signals<Depth>, signals<Torque>>([](Time, double x) { return -2 * x; });
  auto tissue = make_block<struct Tissue, signals<Force>, signals<Depth>>([](Time, double F) { return F / 800; });
  auto heat = make_block<struct Heat, signals<Force>, signals<Temperature>>([](Time, double F) { return 20 + F; });

  auto loop = make_loop<wants<Torque>, inputs<Force>>(drive, heat, tissue);
  const auto [torque, status] = loop.step(Time{0}, 1.6);
  std::printf("torque %.4f N m, %s; Heat is %s\n%s", torque, describe(status).c_str(),
              decltype(loop)::has<struct Heat> ? "in the loop" : "left out", diagram(loop).c_str());
  return torque == -2 * (1.6 / 800) && !decltype(loop)::has<struct Heat> ? 0 : 1;
}
