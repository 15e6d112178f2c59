// SPDX-License-Identifier: MIT
#include "emulated_bus.hpp"

#include "usb_descriptors.hpp"
#include "usbfs_ioctls.hpp"

#include <sys/prctl.h>
#include <sys/stat.h>

#include <array>
#include <cstdio>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace limpid::emulator {
namespace {

template <typename... Arguments>
std::string format(const char* pattern, Arguments... arguments) {
  std::array<char, 64> text{};
  const int length = std::snprintf(text.data(), text.size(), pattern, arguments...);
  return {text.data(), static_cast<std::size_t>(length)};
}

std::string node_of(unsigned bus, unsigned number) { return format("/dev/bus/usb/%03u/%03u", bus, number); }

std::string in_words(gchar* text) {
  std::string copy = text != nullptr ? text : "";
  g_free(text);
  return copy;
}

// A client that is killed in the middle of a call is no fault of the bus, though umockdev complains of it.
void log_but_for_killed_clients(const gchar* domain, GLogLevelFlags level, const gchar* text, gpointer data) {
  if (std::string_view(text).find("Destroying IoctlClient") != std::string_view::npos) return;
  g_log_default_handler(domain, level, text, data);
}

UsbSettings root_hub(unsigned bus) {
  return {.path = std::to_string(bus),
          .vendor = 0x1d6b,
          .product = 0x0002,
          .device_class = 9,
          .maker = "Linux",
          .name = "root hub",
          .interfaces = {{.device_class = 9, .endpoints = {{.address = 0x81, .packet = 4, .interval = 12}}}}};
}

}  // namespace

EmulatedBus::EmulatedBus() {
  ::prctl(PR_SET_TIMERSLACK, 1UL, 0UL, 0UL, 0UL);
  g_log_set_default_handler(log_but_for_killed_clients, nullptr);
  testbed_.reset(umockdev_testbed_new(), [](UMockdevTestbed* one) { g_object_unref(one); });
  if (umockdev_in_mock_environment() == FALSE) {
    throw std::runtime_error("EmulatedBus: expected libumockdev-preload, linked or in LD_PRELOAD, before libc");
  }
  root_ = in_words(umockdev_testbed_get_root_dir(testbed_.get()));
  ::chmod(root_.c_str(), 01777);  // a client without rights, too, listens for events there
  hub(1);                         // libusb looks for /sys/bus/usb only when it starts
}

const std::string& EmulatedBus::hub(unsigned bus) {
  std::string& sysfs = hubs_[bus];
  if (sysfs.empty()) sysfs = add_to_sysfs(root_hub(bus), 1, nullptr);
  return sysfs;
}

// Without DEVTYPE the event that umockdev sends by itself reaches no listener: the node is not there yet.
std::string EmulatedBus::add_to_sysfs(const UsbSettings& settings, unsigned number, const char* parent) {
  const bool is_hub = parent == nullptr;
  const unsigned minor = (settings.bus() - 1) * 128 + number - 1;
  std::vector<std::string> words{"busnum",
                                 std::to_string(settings.bus()),
                                 "devnum",
                                 std::to_string(number),
                                 "dev",
                                 format("189:%u", minor),
                                 "speed",
                                 is_hub ? "480" : "12",
                                 "idVendor",
                                 format("%04x", settings.vendor),
                                 "idProduct",
                                 format("%04x", settings.product),
                                 "bcdDevice",
                                 format("%04x", settings.release),
                                 "bDeviceClass",
                                 format("%02x", settings.device_class),
                                 "bConfigurationValue",
                                 "1",
                                 "bNumConfigurations",
                                 "1",
                                 "bNumInterfaces",
                                 format("%2zu", settings.interfaces.size()),
                                 "manufacturer",
                                 settings.maker,
                                 "product",
                                 settings.name,
                                 "serial",
                                 settings.serial};
  for (std::size_t i = 1; i < words.size(); i += 2) words[i] += '\n';  // as sysfs has them
  std::vector<char*> attributes;
  for (const std::string& word : words) attributes.push_back(const_cast<char*>(word.c_str()));  // NOLINT: only read
  attributes.push_back(nullptr);
  char* no_properties = nullptr;
  const std::string name = is_hub ? "usb" + settings.path : settings.path;
  std::string sysfs = in_words(
      umockdev_testbed_add_devicev(testbed_.get(), "usb", name.c_str(), parent, attributes.data(), &no_properties));
  if (sysfs.empty()) throw std::runtime_error("EmulatedBus: cannot add " + name);

  Bytes descriptors = device_descriptor(settings);
  const Bytes configuration = configuration_descriptor(settings);
  descriptors.insert(descriptors.end(), configuration.begin(), configuration.end());
  umockdev_testbed_set_attribute_binary(testbed_.get(), sysfs.c_str(), "descriptors", descriptors.data(),
                                        static_cast<int>(descriptors.size()));
  const auto set = [&](const char* key, const std::string& value) {
    umockdev_testbed_set_property(testbed_.get(), sysfs.c_str(), key, value.c_str());
  };
  set("MAJOR", "189");
  set("MINOR", std::to_string(minor));
  set("DEVNAME", node_of(settings.bus(), number));
  set("DEVTYPE", "usb_device");
  set("BUSNUM", format("%03u", settings.bus()));
  set("DEVNUM", format("%03u", number));
  set("PRODUCT", format("%x/%x/%x", settings.vendor, settings.product, settings.release));
  return sysfs;
}

EmulatedBus::Plugged::Plugged(EmulatedBus& bus, const UsbSettings& settings) : bus_{bus} {
  const std::lock_guard lock(bus.mutex_);
  unsigned& next = bus.next_.try_emplace(settings.bus(), 2U).first->second;
  if (next > 127) next = 2;
  number_ = next++;
  node_ = node_of(settings.bus(), number_);
  usbfs_ = std::make_shared<Usbfs>(settings, bus.root_ + node_);
  server_ = serve(usbfs_);
  GError* error = nullptr;
  umockdev_testbed_attach_ioctl(bus.testbed_.get(), node_.c_str(), server_.get(), &error);
  g_clear_error(&error);
  ::chmod((bus.root_ + "/ioctl" + node_).c_str(), 0777);  // the node alone decides who may open it
  sysfs_ = bus.add_to_sysfs(settings, number_, bus.hub(settings.bus()).c_str());
  umockdev_testbed_uevent(bus.testbed_.get(), sysfs_.c_str(), "add");
}

EmulatedBus::Plugged::~Plugged() {
  usbfs_->unplug();
  const std::lock_guard lock(bus_.mutex_);
  umockdev_testbed_uevent(bus_.testbed_.get(), sysfs_.c_str(), "remove");
  umockdev_testbed_remove_device(bus_.testbed_.get(), sysfs_.c_str());
  GError* error = nullptr;
  umockdev_testbed_detach_ioctl(bus_.testbed_.get(), node_.c_str(), &error);
  g_clear_error(&error);
}

}  // namespace limpid::emulator

// GLib's locks are futexes of its own, which the thread sanitizer does not see: what one of its threads hands to
// another looks unguarded. libudev takes some random bytes for its tables, once for all threads. Reports with a frame
// in these libraries are left out; a callback from there has none.
extern "C" const char* __tsan_default_suppressions();  // NOLINT: the sanitizer's name

extern "C" const char* __tsan_default_suppressions() {  // NOLINT
  return "race:libglib-2.0.so.0\n"
         "race:libgobject-2.0.so.0\n"
         "race:libgio-2.0.so.0\n"
         "race:libumockdev.so.0\n"
         "race:libudev.so.1\n";
}
