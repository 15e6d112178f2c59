// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/device/usb/usb_counters.hpp>
#include <limpid/device/usb/usb_device.hpp>
#include <limpid/device/usb/usb_error.hpp>
#include <limpid/device/usb/usb_protocol.hpp>

#include <libusb.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <utility>

namespace limpid::detail {

/// The transfers of an open device, all asynchronous: some wait for what it says, some take what it is to hear. Used by
/// the one thread that handles libusb's events.
template <UsbProtocol P>
class UsbStream {
 public:
  using OutFrame = std::array<std::byte, P::out_length>;
  using Receive = std::function<void(std::span<const std::byte>)>;

  /// @throws UsbError  where a transfer cannot be made
  UsbStream(libusb_context* context, std::unique_ptr<UsbHandle> handle, UsbCounters& counters, Receive receive)
      : context_{context}, handle_{std::move(handle)}, counters_{counters}, receive_{std::move(receive)} {
    for (auto& in : ins_) prepare(in, P::in_endpoint, 0, &UsbStream::came);
    for (auto& out : outs_) prepare(out, P::out_endpoint, longest_out, &UsbStream::went);
    tend();
  }
  ~UsbStream() { stop(); }
  UsbStream(const UsbStream&) = delete;
  UsbStream& operator=(const UsbStream&) = delete;
  UsbStream(UsbStream&&) = delete;
  UsbStream& operator=(UsbStream&&) = delete;

  /// Whether the device has gone away.
  [[nodiscard]] bool gone() const noexcept { return gone_; }

  /// Commands that arrived since the stream began.
  [[nodiscard]] std::uint64_t arrived() const noexcept { return arrived_; }

  /// @return  false where all transfers to the device are busy, or it cannot take one: nothing was sent
  bool send(const OutFrame& frame) noexcept {
    const auto idle = std::find_if(outs_.begin(), outs_.end(), [](const auto& out) { return !out.flying; });
    if (idle == outs_.end() || out_halted_ || gone_) return false;
    std::copy(frame.begin(), frame.end(), idle->bytes.begin());
    return submit(*idle);
  }

  /// Whether nothing is on its way to the device.
  [[nodiscard]] bool all_sent() const noexcept {
    return std::none_of(outs_.begin(), outs_.end(), [](const auto& out) { return out.flying; });
  }

  /// Lets libusb work, at most so long; then ends halts, and listens again with what an error has stopped.
  void handle_events(std::chrono::microseconds longest) noexcept {
    timeval wait{.tv_sec = 0, .tv_usec = static_cast<decltype(timeval::tv_usec)>(longest.count())};
    (void)libusb_handle_events_timeout_completed(context_, &wait, nullptr);
    tend();
  }

 private:
  static constexpr unsigned longest_out = 20;  // ms until a transfer to the device is given up
  static constexpr std::chrono::milliseconds longest_stop{500};

  template <std::size_t Length>
  struct Transfer {
    struct Free {
      void operator()(libusb_transfer* made) const noexcept { libusb_free_transfer(made); }
    };
    std::unique_ptr<libusb_transfer, Free> transfer;
    std::array<std::byte, Length> bytes{};
    bool flying = false;
    UsbStream* stream = nullptr;
  };
  using In = Transfer<P::in_length>;
  using Out = Transfer<P::out_length>;

  template <std::size_t Length>
  void prepare(Transfer<Length>& of, std::uint8_t endpoint, unsigned timeout, libusb_transfer_cb_fn done) {
    of.transfer.reset(libusb_alloc_transfer(0));
    of.stream = this;
    if (!of.transfer) throw UsbError(UsbFailure::system, "UsbLink: expected memory for a transfer, got none");
    auto* bytes = reinterpret_cast<unsigned char*>(of.bytes.data());  // NOLINT: bytes are bytes
    const auto fill =
        P::transfer == UsbTransfer::interrupt ? libusb_fill_interrupt_transfer : libusb_fill_bulk_transfer;
    fill(of.transfer.get(), handle_->get(), endpoint, bytes, static_cast<int>(Length), done, &of, timeout);
  }

  template <std::size_t Length>
  bool submit(Transfer<Length>& of) noexcept {
    const int code = libusb_submit_transfer(of.transfer.get());
    of.flying = code == LIBUSB_SUCCESS;
    if (code == LIBUSB_ERROR_NO_DEVICE) gone_ = true;
    return of.flying;
  }

  static void LIBUSB_CALL came(libusb_transfer* transfer) {
    auto& in = *static_cast<In*>(transfer->user_data);
    UsbStream& stream = *in.stream;
    in.flying = false;
    if (transfer->status == LIBUSB_TRANSFER_COMPLETED) {
      stream.receive_(std::span(in.bytes).first(static_cast<std::size_t>(transfer->actual_length)));
      if (!stream.stopping_) (void)stream.submit(in);
      return;
    }
    stream.note_failure(*transfer, UsbCount::in_errors, stream.in_halted_);
  }

  static void LIBUSB_CALL went(libusb_transfer* transfer) {
    auto& out = *static_cast<Out*>(transfer->user_data);
    UsbStream& stream = *out.stream;
    out.flying = false;
    if (transfer->status == LIBUSB_TRANSFER_COMPLETED && transfer->actual_length == transfer->length) {
      stream.counters_.add(UsbCount::commands);
      ++stream.arrived_;
      return;
    }
    stream.note_failure(*transfer, UsbCount::out_errors, stream.out_halted_);
  }

  void note_failure(const libusb_transfer& transfer, UsbCount errors, bool& halted) noexcept {
    if (transfer.status == LIBUSB_TRANSFER_CANCELLED && stopping_) return;
    counters_.add(errors);
    if (transfer.status == LIBUSB_TRANSFER_STALL) halted = true;
    if (transfer.status == LIBUSB_TRANSFER_NO_DEVICE) gone_ = true;
  }

  // Outside the callbacks: what clears a halt waits for the device.
  void tend() noexcept {
    if (gone_ || stopping_) return;
    clear_halt(in_halted_, P::in_endpoint);
    clear_halt(out_halted_, P::out_endpoint);
    if (in_halted_) return;
    for (auto& in : ins_) {
      if (!in.flying && !gone_) (void)submit(in);
    }
  }

  void clear_halt(bool& halted, std::uint8_t endpoint) noexcept {
    if (!halted) return;
    const int code = libusb_clear_halt(handle_->get(), endpoint);
    if (code == LIBUSB_ERROR_NO_DEVICE) gone_ = true;
    if (code != LIBUSB_SUCCESS) return;
    halted = false;
    counters_.add(UsbCount::halts);
  }

  // Nothing may be on its way when the transfers are freed.
  void stop() noexcept {
    stopping_ = true;
    const auto cancel = [](auto& of) {
      if (of.flying) (void)libusb_cancel_transfer(of.transfer.get());
    };
    std::for_each(ins_.begin(), ins_.end(), cancel);
    std::for_each(outs_.begin(), outs_.end(), cancel);
    const auto flying = [](const auto& of) { return of.flying; };
    const auto end = std::chrono::steady_clock::now() + longest_stop;
    while ((std::any_of(ins_.begin(), ins_.end(), flying) || std::any_of(outs_.begin(), outs_.end(), flying)) &&
           std::chrono::steady_clock::now() < end) {
      timeval wait{.tv_sec = 0, .tv_usec = 1000};
      (void)libusb_handle_events_timeout_completed(context_, &wait, nullptr);
    }
    handle_.reset();  // ends what would not be cancelled
  }

  libusb_context* context_;
  std::unique_ptr<UsbHandle> handle_;
  UsbCounters& counters_;
  Receive receive_;
  std::array<In, 4> ins_;
  std::array<Out, 2> outs_;
  std::uint64_t arrived_ = 0;
  bool in_halted_ = false, out_halted_ = false, gone_ = false, stopping_ = false;
};

}  // namespace limpid::detail
