// SPDX-License-Identifier: MIT
// Between umockdev, which carries a client's ioctls and memory, and Usbfs. All runs in umockdev's thread.
#include "usbfs_ioctls.hpp"

#include <linux/usbdevice_fs.h>
#include <sys/ioctl.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <string>
#include <utility>

namespace limpid::emulator {
namespace {

using Memory = std::shared_ptr<UMockdevIoctlData>;  // of the client, mapped here and written back

/// What the `offset` of `outer` points to; null where the client has nothing there.
Memory resolve(UMockdevIoctlData* outer, std::size_t offset, std::size_t length) {
  GError* error = nullptr;
  UMockdevIoctlData* inner = umockdev_ioctl_data_resolve(outer, offset, length, &error);
  g_clear_error(&error);
  return inner != nullptr ? Memory(inner, [](UMockdevIoctlData* data) { g_object_unref(data); }) : nullptr;
}

std::uint64_t word(const UMockdevIoctlData* data) {
  std::uint64_t value = 0;
  std::memcpy(&value, data->data, sizeof(value));
  return value;
}

template <typename T>
T& as(const Memory& data) {
  return *reinterpret_cast<T*>(data->data);  // NOLINT: the client's own structure
}

constexpr std::size_t setup_length = 8;

/// Where the data of a transfer begin in its buffer: a control transfer's come after the request.
std::size_t data_begin(const usbdevfs_urb& urb) { return urb.type == USBDEVFS_URB_TYPE_CONTROL ? setup_length : 0; }

int submit(Usbfs& usbfs, UMockdevIoctlClient* client, const Memory& memory) {
  const auto& theirs = as<usbdevfs_urb>(memory);
  if (theirs.type == USBDEVFS_URB_TYPE_ISO || theirs.buffer_length < 0) return EINVAL;
  const auto length = static_cast<std::size_t>(theirs.buffer_length);
  Urb urb{.client = client,
          .address = memory->client_addr,
          .endpoint = theirs.endpoint,
          .short_not_ok = (theirs.flags & USBDEVFS_URB_SHORT_NOT_OK) != 0,
          .length = length - std::min(length, data_begin(theirs)),
          .memory = memory};
  if (length > 0) {
    const Memory buffer = resolve(memory.get(), offsetof(usbdevfs_urb, buffer), length);
    if (!buffer) return EFAULT;
    const bool control = theirs.type == USBDEVFS_URB_TYPE_CONTROL;
    if (control || !is_in(theirs.endpoint)) urb.data.assign(buffer->data, buffer->data + length);
  }
  return usbfs.submit(std::move(urb));
}

// Where nothing is done, which is every second time, the client's memory is left alone: each look at it is a message.
int reap(Usbfs& usbfs, UMockdevIoctlClient* client, UMockdevIoctlData* argument) {
  std::optional<Urb> urb;
  if (const int none = usbfs.reap(client, urb); none != 0) return none;
  const Memory pointer = resolve(argument, 0, sizeof(void*));
  if (!pointer) return EFAULT;
  const auto memory = std::static_pointer_cast<UMockdevIoctlData>(urb->memory);
  auto& theirs = as<usbdevfs_urb>(memory);
  theirs.status = urb->status;
  theirs.actual_length = static_cast<int>(urb->actual);
  const bool control = theirs.type == USBDEVFS_URB_TYPE_CONTROL;
  if ((control || is_in(urb->endpoint)) && urb->actual > 0) {
    const std::size_t room = static_cast<std::size_t>(theirs.buffer_length) - data_begin(theirs);
    auto* buffer = static_cast<std::uint8_t*>(theirs.buffer) + data_begin(theirs);
    std::copy_n(urb->data.begin(), std::min({urb->data.size(), urb->actual, room}), buffer);
  }
  umockdev_ioctl_data_set_ptr(pointer.get(), 0, memory.get());
  return 0;
}

int get_driver(Usbfs& usbfs, usbdevfs_getdriver& query) {
  std::string name;
  const int answer = usbfs.driver(query.interface, name);
  if (answer == 0) *std::copy_n(name.begin(), std::min(name.size(), sizeof(query.driver) - 1), query.driver) = '\0';
  return answer;
}

/// USBDEVFS_IOCTL with DISCONNECT and CONNECT: the kernel's driver of an interface goes, or comes, which it does not.
int driver_ioctl(Usbfs& usbfs, UMockdevIoctlClient* client, const usbdevfs_ioctl& command) {
  if (command.ioctl_code != static_cast<int>(USBDEVFS_DISCONNECT)) return usbfs.present();
  const auto interface = static_cast<unsigned>(command.ifno);
  std::string name;
  if (const int none = usbfs.driver(interface, name); none != 0) return none;
  if (const int refused = usbfs.claim(client, interface, true); refused != 0) return refused;
  return usbfs.release(client, interface);
}

int answer(Usbfs& usbfs, UMockdevIoctlClient* client) {
  UMockdevIoctlData* argument = umockdev_ioctl_client_get_arg(client);
  const auto request = umockdev_ioctl_client_get_request(client);
  if (request == USBDEVFS_DISCARDURB) return usbfs.discard(client, word(argument));
  if (request == USBDEVFS_RESET) return usbfs.reset();
  if (request == USBDEVFS_REAPURBNDELAY || request == USBDEVFS_REAPURB)
    return reap(usbfs, client, argument);  // no wait
  const Memory data = resolve(argument, 0, _IOC_SIZE(request));
  if (!data) return usbfs.present() != 0 ? ENODEV : ENOTTY;
  switch (request) {
    case USBDEVFS_SUBMITURB:
      return submit(usbfs, client, data);
    case USBDEVFS_GET_CAPABILITIES:
      as<std::uint32_t>(data) = USBDEVFS_CAP_ZERO_PACKET | USBDEVFS_CAP_BULK_CONTINUATION |
                                USBDEVFS_CAP_NO_PACKET_SIZE_LIM | USBDEVFS_CAP_BULK_SCATTER_GATHER |
                                USBDEVFS_CAP_REAP_AFTER_DISCONNECT;
      return usbfs.present();
    case USBDEVFS_CLAIMINTERFACE:
      return usbfs.claim(client, as<unsigned>(data), false);
    case USBDEVFS_DISCONNECT_CLAIM:
      return usbfs.claim(client, as<usbdevfs_disconnect_claim>(data).interface, true);
    case USBDEVFS_RELEASEINTERFACE:
      return usbfs.release(client, as<unsigned>(data));
    case USBDEVFS_GETDRIVER:
      return get_driver(usbfs, as<usbdevfs_getdriver>(data));
    case USBDEVFS_IOCTL:
      return driver_ioctl(usbfs, client, as<usbdevfs_ioctl>(data));
    case USBDEVFS_SETCONFIGURATION:
      return usbfs.set_configuration(as<int>(data));
    case USBDEVFS_SETINTERFACE: {
      const auto& wanted = as<usbdevfs_setinterface>(data);
      const int refused = usbfs.claim(client, wanted.interface, false);
      return refused != 0 ? refused : wanted.altsetting == 0 ? 0 : EINVAL;
    }
    case USBDEVFS_CLEAR_HALT:
    case USBDEVFS_RESETEP:
      return usbfs.clear_halt(static_cast<std::uint8_t>(as<unsigned>(data)));
    default:
      return usbfs.present() != 0 ? ENODEV : ENOTTY;
  }
}

using Shared = std::shared_ptr<Usbfs>;

void complete(UMockdevIoctlClient* client, int error) {
  umockdev_ioctl_client_complete(client, error == 0 ? 0 : -1, error);
}

// umockdev learns a little later than the kernel would that a client has closed its file: until then an interface that
// is free looks taken. So a claim is refused only after 50 ms of asking again.
struct Claim {
  Shared usbfs;
  UMockdevIoctlClient* client;
  int times_left = 50;
};

gboolean claim_again(gpointer asked) {
  auto& claim = *static_cast<Claim*>(asked);
  const int error = answer(*claim.usbfs, claim.client);
  if (error == EBUSY && --claim.times_left > 0) return G_SOURCE_CONTINUE;
  complete(claim.client, error);
  return G_SOURCE_REMOVE;
}

void end_claim(gpointer asked) {
  const std::unique_ptr<Claim> claim(static_cast<Claim*>(asked));
  g_object_unref(claim->client);
}

void claim_later(const Shared& usbfs, UMockdevIoctlClient* client) {
  g_object_ref(client);
  auto claim = std::make_unique<Claim>(Claim{usbfs, client});
  GSource* timer = g_timeout_source_new(1);
  g_source_set_callback(timer, claim_again, claim.release(), end_claim);
  g_source_attach(timer, g_main_context_get_thread_default());
  g_source_unref(timer);
}

gboolean on_ioctl(UMockdevIoctlBase* /*base*/, UMockdevIoctlClient* client, gpointer shared) {
  const Shared& usbfs = *static_cast<Shared*>(shared);
  const auto request = umockdev_ioctl_client_get_request(client);
  const int error = answer(*usbfs, client);
  if (error == EBUSY && (request == USBDEVFS_CLAIMINTERFACE || request == USBDEVFS_DISCONNECT_CLAIM)) {
    claim_later(usbfs, client);
  } else {
    complete(client, error);
  }
  return TRUE;
}

struct Visit {
  Shared usbfs;
};

void on_gone(gpointer visit, GObject* client) {
  const std::unique_ptr<Visit> ended(static_cast<Visit*>(visit));
  ended->usbfs->drop(client);
}

// A client that has closed the node, or has died in whatever it did, is finalised in the end.
void on_connected(UMockdevIoctlBase* /*base*/, UMockdevIoctlClient* client, gpointer shared) {
  auto visit = std::make_unique<Visit>(Visit{*static_cast<Shared*>(shared)});
  g_object_weak_ref(G_OBJECT(client), on_gone, visit.release());
}

void delete_shared(gpointer shared, GClosure* /*closure*/) { delete static_cast<Shared*>(shared); }  // NOLINT

template <typename F>
void connect(UMockdevIoctlBase* base, const char* signal, F* handler, const Shared& usbfs) {
  g_signal_connect_data(base, signal, G_CALLBACK(handler), new Shared(usbfs), delete_shared,
                        GConnectFlags{});  // NOLINT
}

}  // namespace

std::shared_ptr<UMockdevIoctlBase> serve(const std::shared_ptr<Usbfs>& usbfs) {
  std::shared_ptr<UMockdevIoctlBase> base(umockdev_ioctl_base_new(),
                                          [](UMockdevIoctlBase* one) { g_object_unref(one); });
  connect(base.get(), "handle-ioctl", on_ioctl, usbfs);
  connect(base.get(), "client-connected", on_connected, usbfs);
  return base;
}

}  // namespace limpid::emulator
