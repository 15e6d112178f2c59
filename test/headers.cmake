# SPDX-License-Identifier: MIT
# Every public header compiles alone (CMake's header verification, as part of the build), and all of them together
# in two translation units of one program link: nothing that needs `inline` lacks it.

if(CMAKE_VERIFY_INTERFACE_HEADER_SETS)
  add_custom_target(limpid_headers_alone ALL)
  add_dependencies(limpid_headers_alone limpid_verify_interface_header_sets)
endif()

set(all_headers "// Generated: every public header.\n")
foreach(header IN LISTS limpid_headers)
  cmake_path(RELATIVE_PATH header BASE_DIRECTORY "${PROJECT_SOURCE_DIR}/include")
  string(APPEND all_headers "#include <${header}>\n")
endforeach()
file(CONFIGURE OUTPUT all_headers.cpp CONTENT "${all_headers}" @ONLY)
file(CONFIGURE OUTPUT all_headers_again.cpp CONTENT "${all_headers}\nint main() {}\n" @ONLY)
add_executable(limpid_two_units "${CMAKE_CURRENT_BINARY_DIR}/all_headers.cpp"
                                "${CMAKE_CURRENT_BINARY_DIR}/all_headers_again.cpp")
target_link_libraries(limpid_two_units PRIVATE limpid_developer)
add_test(NAME headers.two_units COMMAND limpid_two_units)
