// SPDX-License-Identifier: MIT
#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#define DOCTEST_CONFIG_IMPLEMENT  // implied by the line above only where the header was not precompiled
#include <support/count_allocations.hpp>

#include <doctest/doctest.h>
