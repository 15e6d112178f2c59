# SPDX-License-Identifier: MIT
# The rules of the house that a machine can hold. The clang tools are those of Debian 12: others format and warn
# differently. Where they are absent, their tests are skipped.
add_test(NAME style.rules COMMAND "${CMAKE_COMMAND}" "-Droot=${PROJECT_SOURCE_DIR}" -P
                                  "${CMAKE_CURRENT_SOURCE_DIR}/rules.cmake")

function(add_clang_tool_test tool)
  find_program(LIMPID_${tool} ${tool}-14)
  mark_as_advanced(LIMPID_${tool})
  if(LIMPID_${tool})
    add_test(NAME style.${tool} COMMAND "${LIMPID_${tool}}" ${ARGN})
  else()
    add_test(NAME style.${tool} COMMAND "${CMAKE_COMMAND}" -E echo "skipped: ${tool}-14 is not installed")
    set_tests_properties(style.${tool} PROPERTIES SKIP_REGULAR_EXPRESSION "^skipped")
  endif()
endfunction()

file(GLOB_RECURSE sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/include/*.hpp" "${PROJECT_SOURCE_DIR}/test/*.[ch]pp"
     "${PROJECT_SOURCE_DIR}/bench/*.[ch]pp" "${PROJECT_SOURCE_DIR}/examples/*.[ch]pp")
add_clang_tool_test(clang-format --dry-run --Werror ${sources})
add_clang_tool_test(
  clang-tidy --quiet "--config-file=${PROJECT_SOURCE_DIR}/.clang-tidy" -p "${PROJECT_BINARY_DIR}"
  --extra-arg=-Qunused-arguments # g++'s own
  "${CMAKE_CURRENT_BINARY_DIR}/all_headers.cpp")
