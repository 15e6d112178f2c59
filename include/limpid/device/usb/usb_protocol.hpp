// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/core/time.hpp>

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>

namespace limpid {

/// Vendor and product number of a USB device.
struct UsbIdentity {
  std::uint16_t vendor, product;

  friend constexpr bool operator==(const UsbIdentity&, const UsbIdentity&) = default;
};

/// A control transfer without data to the device, for what a device needs once before it can be used.
struct UsbControl {
  std::uint8_t type, request;
  std::uint16_t value, index;
};

enum class UsbTransfer { bulk, interrupt };

/// What is wrong with a frame.
enum class FrameFault {
  none,
  empty,     ///< nothing in it yet, as the device does between states: no error
  length,    ///< too short or too long
  header,    ///< another protocol, version or kind
  checksum,  ///< not the bytes that were sent
  value,     ///< something in it that no device can mean
};

template <typename State>
struct DecodedFrame {
  State state{};  ///< of use where there is no fault
  FrameFault fault = FrameFault::none;
};

/// What a device says and hears on USB, as static members; for UsbLink. Minimal:
///
///     using State, Command;                                        // copied without throwing
///     static constexpr std::string_view name;
///     static constexpr std::array<UsbIdentity, n> identities;      // the devices that speak it, n > 0
///     static constexpr int interface_number;
///     static constexpr UsbTransfer transfer;
///     static constexpr std::uint8_t in_endpoint, out_endpoint;
///     static constexpr std::size_t in_length, out_length;          // of a transfer, bytes
///     static constexpr bool polled;                                // the device only answers: one state a command
///     static std::array<UsbControl, m> init() noexcept;            // m >= 0
///     static DecodedFrame<State> decode(std::span<const std::byte>) noexcept;
///     static std::array<std::byte, out_length> encode(const Command&, std::uint32_t sequence, Duration watchdog)
///         noexcept;
///     static Command safe() noexcept;                              // no torque, motors off
///     static std::uint32_t steps(const State& from, const State& to) noexcept;
///
/// Laws: `decode` accepts any bytes; `steps` is the number of frames from one state to another, 1 where none was lost,
/// 0 for the same one again where they are numbered; in a frame of `encode` the device finds after how long without a
/// valid one it is to take its motors off, where it knows such a time. Models: OmniBridge, Falcon.
/// test/conformance/usb_protocol_suite.hpp checks them.
template <typename P>
concept UsbProtocol = requires(std::span<const std::byte> bytes, const typename P::State& state,
                               const typename P::Command& command, std::uint32_t sequence, Duration watchdog) {
  { P::name } -> std::convertible_to<std::string_view>;
  { P::identities.front() } -> std::convertible_to<UsbIdentity>;
  { P::interface_number } -> std::convertible_to<int>;
  { P::transfer } -> std::convertible_to<UsbTransfer>;
  { P::in_endpoint } -> std::convertible_to<std::uint8_t>;
  { P::out_endpoint } -> std::convertible_to<std::uint8_t>;
  { P::in_length } -> std::convertible_to<std::size_t>;
  { P::polled } -> std::convertible_to<bool>;
  { P::init().size() }
  noexcept->std::convertible_to<std::size_t>;
  { P::decode(bytes) }
  noexcept->std::same_as<DecodedFrame<typename P::State>>;
  { P::encode(command, sequence, watchdog) }
  noexcept->std::same_as<std::array<std::byte, P::out_length>>;
  { P::safe() }
  noexcept->std::same_as<typename P::Command>;
  { P::steps(state, state) }
  noexcept->std::same_as<std::uint32_t>;
}
&&std::is_nothrow_copy_assignable_v<typename P::State>&& std::is_nothrow_copy_assignable_v<typename P::Command>;

}  // namespace limpid
