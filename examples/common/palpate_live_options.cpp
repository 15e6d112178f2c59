// SPDX-License-Identifier: MIT
#include "palpate_live_options.hpp"

#include "omni_calibration_file.hpp"
#include "option_values.hpp"

namespace limpid::examples {

void add_live_options(CLI::App& app, TypedLive& typed) {
  app.add_option("--device", typed.device, "simulated, or usb: an Omni behind an OmniBridge; implies --realtime")
      ->check(CLI::IsMember({"simulated", "usb"}));
  app.add_option("--calibration", typed.calibration, "of the Omni on USB, JSON: its torque scale has no default")
      ->check(CLI::ExistingFile);
  app.add_option("--usb-path", typed.usb_path, "which device on USB, as 1-2.4; default: the only one");
  app.add_flag("--realtime", typed.realtime,
               "by the machine's clock, with SCHED_FIFO and locked memory where permitted, and the tissue on a thread "
               "of its own");
}

std::optional<LiveSettings> live_of(const CLI::App& app, const TypedLive& typed, const Scene& scene,
                                    std::size_t predictors) {
  const bool usb = typed.device == "usb";
  for (const char* option : {"--calibration", "--usb-path"}) {
    if (!usb && app.count(option) > 0) refuse(option, "goes with --device usb");
  }
  if (!usb && !typed.realtime) return {};
  const std::string with = usb ? " with --device usb" : " with --realtime";
  if (usb && typed.calibration.empty()) refuse("--device", "usb goes with --calibration FILE: the torque scale");
  if (usb && !scene.playback) {
    refuse("--device", "usb goes with --playback: no sensor tells the force of a hand on the device");
  }
  if (usb && app.count("--robot") > 0) refuse("--robot", "chooses the simulated one");
  if (predictors != 1) refuse("--predictor", "accepts one" + with + ", got " + std::to_string(predictors));
  if (scene.hand) refuse("--operator", "accepts force" + with);
  if (scene.disturbances.sensing.any()) {
    refuse("--force-noise, --state-noise, --quantise, --jitter, --loss", "accept nothing" + with);
  }
  LiveSettings live;
  live.device = usb ? DeviceKind::usb : DeviceKind::simulated;
  if (usb) live.calibration = read_omni_calibration(typed.calibration);
  live.usb_path = typed.usb_path;
  live.priority = typed.realtime ? 80 : 0;
  live.lock_memory = typed.realtime;
  return live;
}

}  // namespace limpid::examples
