// SPDX-License-Identifier: MIT
#include "tick/form.hpp"

namespace limpid::bench {

Form composed_safe_form() { return form_of<double>("composed_with_safety", composed_safe_tick<double>()); }

}  // namespace limpid::bench
