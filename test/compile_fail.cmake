# SPDX-License-Identifier: MIT
# Each test/compile_fail/*.cpp must be refused by the compiler with a text that matches every `// expect: REGEX` line
# of it (CMake's regular expressions), under the options of each `// options:` line of it, if there are any. Included by
# CMake it makes the tests, run by `cmake -P` it is the test.

if(NOT CMAKE_SCRIPT_MODE_FILE)
  set(includes "$<TARGET_PROPERTY:limpid_test_support,INCLUDE_DIRECTORIES>")
  file(GLOB sources CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/compile_fail/*.cpp")
  foreach(source IN LISTS sources)
    cmake_path(GET source STEM name)
    add_test(
      NAME compile_fail.${name}
      COMMAND "${CMAKE_COMMAND}" "-Dsource=${source}" "-Dcompiler=${CMAKE_CXX_COMPILER}" "-Dincludes=${includes}" -P
              "${CMAKE_CURRENT_SOURCE_DIR}/compile_fail.cmake")
  endforeach()
  return()
endif()

cmake_minimum_required(VERSION 3.25)
file(STRINGS "${source}" expected REGEX "^// expect: ")
if(NOT expected)
  message(FATAL_ERROR "${source}: expected a line `// expect: REGEX`, got none")
endif()
list(TRANSFORM includes PREPEND -I)
file(STRINGS "${source}" option_lines REGEX "^// options: ")
if(NOT option_lines)
  set(option_lines "// options:")
endif()
foreach(option_line IN LISTS option_lines)
  string(REGEX REPLACE "^// options: *" "" options "${option_line}")
  separate_arguments(arguments UNIX_COMMAND "${options}")
  execute_process(
    COMMAND "${compiler}" -std=c++20 -fsyntax-only ${arguments} ${includes} "${source}"
    RESULT_VARIABLE result
    OUTPUT_VARIABLE text
    ERROR_VARIABLE text)
  if(result EQUAL 0)
    message(FATAL_ERROR "${source}: expected a refusal, but it compiles ${options}")
  endif()
  foreach(line IN LISTS expected)
    string(REGEX REPLACE "^// expect: *" "" regex "${line}")
    if(NOT text MATCHES "${regex}")
      message(FATAL_ERROR "${source}: expected a compiler's text that matches \"${regex}\", got ${options}\n${text}")
    endif()
  endforeach()
endforeach()
