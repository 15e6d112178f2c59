// SPDX-License-Identifier: MIT
#include "tick/form.hpp"

namespace limpid::bench {

Form composed_float_form() { return form_of<float>("composed_float", composed_tick<float>()); }

}  // namespace limpid::bench
