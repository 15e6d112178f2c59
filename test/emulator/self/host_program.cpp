// SPDX-License-Identifier: MIT
// A host for tests of omni_emulator: opens the Omni, commands a torque every time a frame has come, for so many frames.
#include "command.hpp"

#include <emulator/plain_client.hpp>

#include <cstdlib>

using namespace limpid::emulator;

int main(int argc, char** argv) {
  const int frames = argc > 1 ? std::atoi(argv[1]) : 100;
  PlainClient client;
  if (client.open(0x1209, 0x0001) != 0 || client.claim() != 0) return 3;
  client.stream();
  std::uint32_t sequence = 0;
  for (int i = 0; i < frames; ++i) {
    if (!client.next()) return 4;
    if (client.send(command(++sequence, {2047, 3000, 2047}, true, 40)) != 0) return 5;
  }
  return client.send(command(++sequence, {2047, 2047, 2047}, false, 40)) == 0 ? 7 : 6;
}
