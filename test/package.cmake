# SPDX-License-Identifier: MIT
# A project that uses limpid: from an installation, from its sources, and by Conan where Conan is.
set(consumer "${CMAKE_CURRENT_SOURCE_DIR}/package")
set(prefix "${CMAKE_CURRENT_BINARY_DIR}/package/prefix")

function(add_consumer_test name)
  add_test(
    NAME package.${name}
    COMMAND
      "${CMAKE_CTEST_COMMAND}" --build-and-test "${consumer}" "${CMAKE_CURRENT_BINARY_DIR}/package/${name}"
      --build-generator "${CMAKE_GENERATOR}" --build-options "-DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER}" ${ARGN}
      --test-command consumer)
endfunction()

add_test(NAME package.install COMMAND "${CMAKE_COMMAND}" --install "${PROJECT_BINARY_DIR}" --prefix "${prefix}")
set_tests_properties(package.install PROPERTIES FIXTURES_SETUP limpid_installed)

add_consumer_test(find_package "-DCMAKE_PREFIX_PATH=${prefix}")
set_tests_properties(package.find_package PROPERTIES FIXTURES_REQUIRED limpid_installed)

add_consumer_test(add_subdirectory "-DLIMPID_SOURCE_DIR=${PROJECT_SOURCE_DIR}")

find_program(conan conan)
mark_as_advanced(conan)
if(conan)
  add_test(NAME package.conan COMMAND "${conan}" create "${PROJECT_SOURCE_DIR}" --build=missing)
else()
  add_test(NAME package.conan COMMAND "${CMAKE_COMMAND}" -E echo "skipped: conan is not installed")
  set_tests_properties(package.conan PROPERTIES SKIP_REGULAR_EXPRESSION "^skipped")
endif()
