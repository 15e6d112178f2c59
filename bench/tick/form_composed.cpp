// SPDX-License-Identifier: MIT
#include "tick/form.hpp"

namespace limpid::bench {

Form composed_form() { return form_of<double>("composed", composed_tick<double>()); }

}  // namespace limpid::bench
