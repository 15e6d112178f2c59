// SPDX-License-Identifier: MIT
#pragma once

#include "usb_settings.hpp"
#include "usbfs_node.hpp"

#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

namespace limpid::emulator {

/// A transfer that a client has submitted.
struct Urb {
  const void* client = nullptr;  ///< who submitted it
  std::uint64_t address = 0;     ///< its name: where it is in the client's memory
  std::uint8_t endpoint = 0;
  bool short_not_ok = false;
  Bytes data{};            ///< what an OUT transfer brings; what an IN transfer has got
  std::size_t length = 0;  ///< of the client's buffer, bytes
  int status = 0;          ///< 0, or an errno with a minus
  std::size_t actual = 0;  ///< bytes transferred
  std::shared_ptr<void> memory{};
};

/// What usbfs does for one plugged device, between clients that submit and reap transfers and a device that serves
/// them. The answers to clients are 0 or an errno. Thread-safe.
class Usbfs {
 public:
  using Client = const void*;

  Usbfs(UsbSettings settings, const std::string& node) : settings_{std::move(settings)}, node_{node, settings_.mode} {}

  int submit(Urb urb);
  int discard(Client client, std::uint64_t address);
  int reap(Client client, std::optional<Urb>& urb);  ///< EAGAIN where there is none
  int claim(Client client, unsigned interface, bool from_driver);
  int release(Client client, unsigned interface);
  int driver(unsigned interface, std::string& name);
  int set_configuration(int value);
  int clear_halt(std::uint8_t endpoint);
  int reset();
  int present();             ///< 0, or ENODEV once unplugged
  void drop(Client client);  ///< it has closed the node, or has died

  /// How a packet went.
  enum class Sent { taken, kept, replaced, refused };
  /// From the device: to the oldest transfer that waits; else kept, two at most, of which the older one goes.
  Sent send(std::uint8_t endpoint, const Bytes& packet);
  /// To the device: the oldest packet that waits.
  std::optional<Bytes> receive(std::uint8_t endpoint);
  /// Ends the oldest transfer that waits with an error, EPROTO or EOVERFLOW; false where none waits.
  bool fail(std::uint8_t endpoint, int error);
  /// Every transfer of the endpoint ends with EPIPE until the host clears the halt, or `halted` is false again.
  void halt(std::uint8_t endpoint, bool halted);
  [[nodiscard]] bool halted(std::uint8_t endpoint);
  /// No transfer of the endpoint is taken from the host, but this error given; 0: it is again.
  void refuse(std::uint8_t endpoint, int error);
  void unplug();  ///< all transfers end with ENODEV, and so does everything that comes later
  [[nodiscard]] bool claimed(unsigned interface);

 private:
  struct Endpoint {
    std::deque<Urb> waiting;
    std::deque<Bytes> kept;
    bool halted = false;
    int refusal = 0;  // of what is submitted
  };
  static constexpr std::size_t most_kept = 2;

  void finish(Urb urb, int error);
  void fill(Urb urb, const Bytes& packet);
  void finish_all(Endpoint& endpoint, int error);
  void control(Urb urb);
  [[nodiscard]] std::optional<unsigned> interface_of(std::uint8_t endpoint) const;
  int claim_unlocked(Client client, unsigned interface, bool from_driver);

  std::mutex mutex_;
  UsbSettings settings_;
  UsbfsNode node_;
  std::map<std::uint8_t, Endpoint> endpoints_;
  std::map<unsigned, Client> claims_;
  std::deque<Urb> done_;
  bool gone_ = false;
};

}  // namespace limpid::emulator
