// SPDX-License-Identifier: MIT
#include "usbfs.hpp"

#include "usb_descriptors.hpp"

#include <algorithm>
#include <cerrno>
#include <utility>

namespace limpid::emulator {

int Usbfs::present() {
  const std::lock_guard lock(mutex_);
  return gone_ ? ENODEV : 0;
}

int Usbfs::submit(Urb urb) {
  const std::lock_guard lock(mutex_);
  if (gone_) return ENODEV;
  if ((urb.endpoint & 0x7fU) == 0) {
    control(std::move(urb));
    return 0;
  }
  const auto interface = interface_of(urb.endpoint);
  if (!interface) return ENOENT;
  if (const int refused = claim_unlocked(urb.client, *interface, false); refused != 0) return refused;  // as the kernel
  Endpoint& endpoint = endpoints_[urb.endpoint];
  if (endpoint.refusal != 0) return endpoint.refusal;
  if (endpoint.halted) {
    finish(std::move(urb), EPIPE);
  } else if (is_in(urb.endpoint) && !endpoint.kept.empty()) {
    fill(std::move(urb), endpoint.kept.front());
    endpoint.kept.pop_front();
  } else {
    endpoint.waiting.push_back(std::move(urb));
  }
  return 0;
}

int Usbfs::discard(Client client, std::uint64_t address) {
  const std::lock_guard lock(mutex_);
  for (auto& [number, endpoint] : endpoints_) {
    auto& waiting = endpoint.waiting;
    const auto urb = std::find_if(waiting.begin(), waiting.end(),
                                  [&](const Urb& one) { return one.client == client && one.address == address; });
    if (urb == waiting.end()) continue;
    finish(std::move(*urb), ENOENT);
    waiting.erase(urb);
    return 0;
  }
  return gone_ ? ENODEV : EINVAL;
}

int Usbfs::reap(Client client, std::optional<Urb>& urb) {
  const std::lock_guard lock(mutex_);
  const auto done = std::find_if(done_.begin(), done_.end(), [&](const Urb& one) { return one.client == client; });
  if (done == done_.end()) return gone_ ? ENODEV : EAGAIN;
  urb = std::move(*done);
  done_.erase(done);
  if (done_.empty()) node_.set_ready(false);
  return 0;
}

int Usbfs::claim(Client client, unsigned interface, bool from_driver) {
  const std::lock_guard lock(mutex_);
  if (gone_) return ENODEV;
  return claim_unlocked(client, interface, from_driver);
}

int Usbfs::claim_unlocked(Client client, unsigned interface, bool from_driver) {
  if (interface >= settings_.interfaces.size()) return ENOENT;
  const auto owner = claims_.find(interface);
  if (owner != claims_.end()) return owner->second == client ? 0 : EBUSY;
  std::string& kernel = settings_.interfaces[interface].driver;
  if (!kernel.empty() && !from_driver) return EBUSY;
  kernel.clear();
  claims_[interface] = client;
  return 0;
}

int Usbfs::release(Client client, unsigned interface) {
  const std::lock_guard lock(mutex_);
  if (gone_) return ENODEV;
  const auto owner = claims_.find(interface);
  if (owner == claims_.end() || owner->second != client) return EINVAL;
  claims_.erase(owner);
  return 0;
}

int Usbfs::driver(unsigned interface, std::string& name) {
  const std::lock_guard lock(mutex_);
  if (gone_) return ENODEV;
  if (interface >= settings_.interfaces.size()) return ENODATA;
  name = claims_.contains(interface) ? "usbfs" : settings_.interfaces[interface].driver;
  return name.empty() ? ENODATA : 0;
}

int Usbfs::set_configuration(int value) {
  const std::lock_guard lock(mutex_);
  if (gone_) return ENODEV;
  if (!claims_.empty()) return EBUSY;
  return value == 1 ? 0 : EINVAL;
}

int Usbfs::clear_halt(std::uint8_t endpoint) {
  const std::lock_guard lock(mutex_);
  if (gone_) return ENODEV;
  if (!interface_of(endpoint)) return ENOENT;
  endpoints_[endpoint].halted = false;
  return 0;
}

int Usbfs::reset() {
  const std::lock_guard lock(mutex_);
  if (gone_) return ENODEV;
  for (auto& [number, endpoint] : endpoints_) {
    finish_all(endpoint, EPROTO);
    endpoint.halted = false;
  }
  return 0;
}

void Usbfs::drop(Client client) {
  const std::lock_guard lock(mutex_);
  const auto is_theirs = [&](const Urb& urb) { return urb.client == client; };
  for (auto& [number, endpoint] : endpoints_) std::erase_if(endpoint.waiting, is_theirs);
  std::erase_if(done_, is_theirs);
  std::erase_if(claims_, [&](const auto& claim) { return claim.second == client; });
  if (done_.empty()) node_.set_ready(false);
}

Usbfs::Sent Usbfs::send(std::uint8_t endpoint, const Bytes& packet) {
  const std::lock_guard lock(mutex_);
  Endpoint& end = endpoints_[endpoint];
  if (gone_ || end.halted) return Sent::refused;
  if (!end.waiting.empty()) {
    fill(std::move(end.waiting.front()), packet);
    end.waiting.pop_front();
    return Sent::taken;
  }
  end.kept.push_back(packet);
  if (end.kept.size() <= most_kept) return Sent::kept;
  end.kept.pop_front();
  return Sent::replaced;
}

std::optional<Bytes> Usbfs::receive(std::uint8_t endpoint) {
  const std::lock_guard lock(mutex_);
  Endpoint& end = endpoints_[endpoint];
  if (gone_ || end.waiting.empty()) return std::nullopt;
  Urb urb = std::move(end.waiting.front());
  end.waiting.pop_front();
  urb.actual = urb.data.size();
  Bytes packet = urb.data;
  finish(std::move(urb), 0);
  return packet;
}

bool Usbfs::fail(std::uint8_t endpoint, int error) {
  const std::lock_guard lock(mutex_);
  auto& waiting = endpoints_[endpoint].waiting;
  if (gone_ || waiting.empty()) return false;
  finish(std::move(waiting.front()), error);
  waiting.pop_front();
  return true;
}

void Usbfs::halt(std::uint8_t endpoint, bool halted) {
  const std::lock_guard lock(mutex_);
  Endpoint& end = endpoints_[endpoint];
  end.halted = halted;
  end.kept.clear();
  if (halted) finish_all(end, EPIPE);
}

bool Usbfs::halted(std::uint8_t endpoint) {
  const std::lock_guard lock(mutex_);
  return endpoints_[endpoint].halted;
}

void Usbfs::refuse(std::uint8_t endpoint, int error) {
  const std::lock_guard lock(mutex_);
  endpoints_[endpoint].refusal = error;
}

void Usbfs::unplug() {
  const std::lock_guard lock(mutex_);
  gone_ = true;
  node_.remove();
  for (auto& [number, endpoint] : endpoints_) finish_all(endpoint, ENODEV);
}

bool Usbfs::claimed(unsigned interface) {
  const std::lock_guard lock(mutex_);
  return claims_.contains(interface);
}

void Usbfs::finish(Urb urb, int error) {
  urb.status = -error;
  done_.push_back(std::move(urb));
  node_.set_ready(true);
}

// An IN transfer's end with a packet.
void Usbfs::fill(Urb urb, const Bytes& packet) {
  urb.actual = std::min(packet.size(), urb.length);
  urb.data.assign(packet.begin(), packet.begin() + static_cast<std::ptrdiff_t>(urb.actual));
  const bool too_long = packet.size() > urb.length;
  const bool too_short = urb.short_not_ok && packet.size() < urb.length;
  finish(std::move(urb), too_long ? EOVERFLOW : too_short ? EREMOTEIO : 0);
}

void Usbfs::finish_all(Endpoint& endpoint, int error) {
  for (Urb& urb : endpoint.waiting) finish(std::move(urb), error);
  endpoint.waiting.clear();
}

// A control transfer is answered at once; its data come after the 8 bytes of the request.
void Usbfs::control(Urb urb) {
  const auto answer = answer_control(settings_, urb.data);
  urb.actual = answer ? answer->size() : 0;
  urb.data = answer.value_or(Bytes{});
  finish(std::move(urb), answer ? 0 : EPIPE);
}

std::optional<unsigned> Usbfs::interface_of(std::uint8_t endpoint) const {
  for (unsigned i = 0; i < settings_.interfaces.size(); ++i) {
    for (const UsbEndpoint& one : settings_.interfaces[i].endpoints)
      if (one.address == endpoint) return i;
  }
  return std::nullopt;
}

}  // namespace limpid::emulator
