// SPDX-License-Identifier: MIT
#pragma once

#include "design/palpation.hpp"

#include <limpid/design/delay_stability.hpp>

#include <cmath>
#include <random>

namespace limpid::test {

struct DelayCase {
  DelaySystem<double> system;
  Tissue<double> tissue;
  Gain<double> L;
};

/// A delay, a tissue and a gain within a decade of what is palpated.
inline DelayCase draw_delay_case(std::mt19937& generator) {
  const auto decade = [&](double middle) {
    return middle * std::pow(10, std::uniform_real_distribution<double>(-1, 1)(generator));
  };
  const auto part = [&] { return std::uniform_real_distribution<double>(-1.5, 1.5)(generator); };
  const Tissue<double> tissue{decade(500), decade(30)};
  return {{tool, decade(0.02)}, tissue, {tissue.stiffness * part(), tissue.damping * part()}};
}

}  // namespace limpid::test
