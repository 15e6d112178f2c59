# SPDX-License-Identifier: MIT
# How limpid's own tests, examples and benchmarks are compiled; nobody who uses the library sees it.

add_library(limpid_developer INTERFACE)
target_link_libraries(limpid_developer INTERFACE limpid::limpid)
target_compile_options(limpid_developer INTERFACE -Wall -Wextra -Wconversion -Wshadow
                                                  $<$<BOOL:${LIMPID_WARNINGS_AS_ERRORS}>:-Werror>)
# g++ collects its garbage from 128 MB on, which takes it 5 to 8 % of its time here: from 768 MB on.
target_compile_options(limpid_developer INTERFACE $<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=786432>)

# The solvers of design/, compiled once for tests, examples and debug benchmarks.
file(GLOB instances CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/cmake/design_instances/*.cpp")
add_library(limpid_design_instances STATIC EXCLUDE_FROM_ALL ${instances})
target_include_directories(limpid_design_instances PUBLIC "${PROJECT_SOURCE_DIR}/cmake/design_instances")
target_link_libraries(limpid_design_instances PUBLIC limpid_developer)
