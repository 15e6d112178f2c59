// SPDX-License-Identifier: MIT
#include "plain_client.hpp"

namespace limpid::emulator {
namespace {

// As libusb's synchronous calls have it.
int error_of(libusb_transfer_status status) {
  switch (status) {
    case LIBUSB_TRANSFER_COMPLETED:
      return 0;
    case LIBUSB_TRANSFER_TIMED_OUT:
      return LIBUSB_ERROR_TIMEOUT;
    case LIBUSB_TRANSFER_STALL:
      return LIBUSB_ERROR_PIPE;
    case LIBUSB_TRANSFER_OVERFLOW:
      return LIBUSB_ERROR_OVERFLOW;
    case LIBUSB_TRANSFER_NO_DEVICE:
      return LIBUSB_ERROR_NO_DEVICE;
    default:
      return LIBUSB_ERROR_IO;
  }
}

}  // namespace

std::string path_of(libusb_device* device) {
  std::array<std::uint8_t, 8> ports{};
  const int count = libusb_get_port_numbers(device, ports.data(), static_cast<int>(ports.size()));
  std::string path = std::to_string(libusb_get_bus_number(device));
  for (int i = 0; i < count; ++i) path += (i == 0 ? "-" : ".") + std::to_string(ports[static_cast<std::size_t>(i)]);
  return path;
}

int PlainClient::open(std::uint16_t vendor, std::uint16_t product, const char* path) {
  libusb_device** list = nullptr;
  const auto count = libusb_get_device_list(context_, &list);
  int answer = LIBUSB_ERROR_NOT_FOUND;
  for (ssize_t i = 0; i < count && answer == LIBUSB_ERROR_NOT_FOUND; ++i) {
    libusb_device_descriptor is{};
    libusb_get_device_descriptor(list[i], &is);
    const bool there = path == nullptr || path_of(list[i]) == path;
    if (is.idVendor == vendor && is.idProduct == product && there) answer = libusb_open(list[i], &handle_);
  }
  libusb_free_device_list(list, 1);
  return answer;
}

void PlainClient::close() {
  stop();
  if (handle_ != nullptr) libusb_close(handle_);
  handle_ = nullptr;
}

void PlainClient::stream(std::uint8_t endpoint, int count, std::uint8_t flags) {
  again_ = running_ = true;
  thread_ = std::thread([this] { run(); });
  for (int i = 0; i < count; ++i) {
    ins_.push_back(std::make_unique<In>(In{this, libusb_alloc_transfer(0), {}}));
    In& in = *ins_.back();
    libusb_fill_interrupt_transfer(in.transfer, handle_, endpoint, in.buffer.data(), 64, ended, &in, 0);
    in.transfer->flags = flags;
    const std::lock_guard lock(mutex_);
    if (libusb_submit_transfer(in.transfer) == 0) ++going_;
  }
}

void PlainClient::ended(libusb_transfer* transfer) {
  auto& in = *static_cast<In*>(transfer->user_data);
  PlainClient& client = *in.client;
  const std::lock_guard lock(client.mutex_);
  const auto* begin = in.buffer.data();
  client.ends_.push_back({transfer->status, Bytes(begin, begin + transfer->actual_length)});
  const bool over = transfer->status == LIBUSB_TRANSFER_CANCELLED || transfer->status == LIBUSB_TRANSFER_NO_DEVICE ||
                    transfer->status == LIBUSB_TRANSFER_STALL;
  const int answer = over || !client.again_ ? LIBUSB_ERROR_INTERRUPTED : libusb_submit_transfer(transfer);
  if (answer == LIBUSB_ERROR_NO_DEVICE) client.ends_.push_back({LIBUSB_TRANSFER_NO_DEVICE, {}});  // went meanwhile
  if (answer != 0) --client.going_;
  client.came_.notify_all();
}

void PlainClient::stop() {
  again_ = false;
  {
    std::unique_lock lock(mutex_);
    for (const auto& in : ins_) libusb_cancel_transfer(in->transfer);
    came_.wait_for(lock, std::chrono::seconds(2), [this] { return going_ <= 0; });
  }
  running_ = false;
  if (thread_.joinable()) thread_.join();
  for (const auto& in : ins_) libusb_free_transfer(in->transfer);
  ins_.clear();
  const std::lock_guard lock(mutex_);
  ends_.clear();
  going_ = 0;
}

std::optional<PlainClient::End> PlainClient::next() {
  std::unique_lock lock(mutex_);
  if (!came_.wait_for(lock, std::chrono::seconds(2), [this] { return !ends_.empty(); })) return std::nullopt;
  End end = std::move(ends_.front());
  ends_.pop_front();
  return end;
}

std::optional<PlainClient::End> PlainClient::find(const std::function<bool(const End&)>& wanted) {
  for (int i = 0; i < 4000; ++i) {
    const auto end = next();
    if (!end || wanted(*end)) return end;
  }
  return std::nullopt;
}

int PlainClient::send(Bytes bytes, unsigned timeout_ms, std::uint8_t endpoint) {
  Out out{this};
  const std::unique_ptr<libusb_transfer, void (*)(libusb_transfer*)> transfer(libusb_alloc_transfer(0),
                                                                              libusb_free_transfer);
  libusb_fill_interrupt_transfer(transfer.get(), handle_, endpoint, bytes.data(), static_cast<int>(bytes.size()), sent,
                                 &out, timeout_ms);
  if (const int refused = libusb_submit_transfer(transfer.get()); refused != 0) return refused;
  std::unique_lock lock(mutex_);
  while (!out.status) {
    if (thread_.joinable()) {
      came_.wait(lock);
      continue;
    }
    lock.unlock();
    timeval wait{0, 20'000};
    libusb_handle_events_timeout(context_, &wait);
    lock.lock();
  }
  return error_of(*out.status);
}

void PlainClient::sent(libusb_transfer* transfer) {
  auto& out = *static_cast<Out*>(transfer->user_data);
  const std::lock_guard lock(out.client->mutex_);
  out.status = transfer->status;
  out.client->came_.notify_all();
}

void PlainClient::run() {
  timeval wait{0, 20'000};
  while (running_) libusb_handle_events_timeout(context_, &wait);
}

}  // namespace limpid::emulator
