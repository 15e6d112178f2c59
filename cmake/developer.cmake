# SPDX-License-Identifier: MIT
# How limpid's own tests, examples and benchmarks are compiled; nobody who uses the library sees it.

add_library(limpid_developer INTERFACE)
target_link_libraries(limpid_developer INTERFACE limpid::limpid)
target_compile_options(limpid_developer INTERFACE -Wall -Wextra -Wconversion -Wshadow
                                                  $<$<BOOL:${LIMPID_WARNINGS_AS_ERRORS}>:-Werror>)
