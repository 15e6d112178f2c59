// SPDX-License-Identifier: MIT
#pragma once

#include <limpid/device/usb/omni_calibration.hpp>

#include <string>

namespace limpid::examples {

/// An Omni's calibration from a JSON file: an object with OmniCalibration's fields by their names, of which
/// `full_scale`, N m, must be there; what else is not there has its default.
/// ```json
/// {"full_scale": [0.3, 0.3, 0.2], "home": [0, 0.23, -0.37]}
/// ```
/// @throws std::invalid_argument  "PATH: FIELD: expected ..., got ..." where the file cannot be read, is no JSON, has
///                                a field that is unknown, twice there, or not of its type and length, or where a
///                                value cannot serve
[[nodiscard]] OmniCalibration read_omni_calibration(const std::string& path);

/// Writes all fields, so that they are read again to the last bit.
/// @throws std::invalid_argument  where a value cannot serve
/// @throws std::runtime_error     where the file cannot be written
void write_omni_calibration(const std::string& path, const OmniCalibration& calibration);

}  // namespace limpid::examples
