// SPDX-License-Identifier: MIT
// Any bytes from a force sensor: the same is found in them whole and in pieces, and every byte is accounted for. The
// first byte chooses the length of the pieces.
#include <limpid/device/opto_force_parser.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

namespace {

struct Reader {
  limpid::OptoForceParser parser;
  std::uint64_t frames = 0, answers = 0, sum = 0;

  void take(std::span<const std::uint8_t> bytes) {
    parser.take(
        bytes,
        [this](const limpid::OptoForceFrame& frame) noexcept {
          ++frames;
          sum = 31 * sum + frame.number + frame.status;
          for (const std::int16_t count : frame.counts) sum = 31 * sum + static_cast<std::uint64_t>(count);
        },
        [this](const limpid::OptoForceAnswer& answer) noexcept {
          ++answers;
          sum = 31 * sum + answer.error;
        });
  }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::span<const std::uint8_t> bytes(data + 1, size - 1);
  const std::size_t piece = 1U + data[0] % 40U;
  Reader whole, parts;
  whole.take(bytes);
  for (std::size_t at = 0; at < bytes.size(); at += piece) {
    parts.take(bytes.subspan(at, std::min(piece, bytes.size() - at)));
  }
  if (whole.sum != parts.sum || whole.frames != parts.frames || whole.answers != parts.answers) __builtin_trap();
  const auto &mine = whole.parser.counters(), &others = parts.parser.counters();
  if (mine.lost != others.lost || mine.restarts != others.restarts || mine.skipped != others.skipped ||
      mine.bad_checksums != others.bad_checksums || mine.frames != whole.frames) {
    __builtin_trap();
  }
  const std::uint64_t known = 16 * whole.frames + 7 * whole.answers + mine.skipped;
  if (known > bytes.size() || bytes.size() - known >= 16) __builtin_trap();
  return 0;
}
