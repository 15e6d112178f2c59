// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/time.hpp>

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>

namespace limpid {

/// What a read from a port gave.
struct PortRead {
  std::size_t bytes = 0;  ///< 0 where none came in time
  bool open = true;       ///< false: the other side is gone, or the port failed; nothing more will come
};

/// A line for bytes, both ways, to somebody who may go away and come back.
///
///     bool open() noexcept;                                        // anew, whether or not it was open; whether it is
///     PortRead read(std::span<std::uint8_t>, Duration) noexcept;   // waits for the first byte, no longer than that
///     bool write(std::span<const std::uint8_t>) noexcept;          // all of them, in bounded time; whether it could
///     void close() noexcept;
///
/// `read` and `write` of a port that is not open fail. All are called by one thread. Models: SerialPort.
template <typename P>
concept BytePort = std::move_constructible<P> &&
    requires(P& port, std::span<std::uint8_t> into, std::span<const std::uint8_t> from, Duration longest) {
  { port.open() }
  noexcept->std::same_as<bool>;
  { port.read(into, longest) }
  noexcept->std::same_as<PortRead>;
  { port.write(from) }
  noexcept->std::same_as<bool>;
  { port.close() }
  noexcept->std::same_as<void>;
};

}  // namespace limpid
