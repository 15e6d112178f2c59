# SPDX-License-Identifier: MIT
# One source of several, which a compiler takes in less time than each of them: what they include and instantiate, it
# sees once. First stands what any of them includes, then each in a namespace of its own, by its own lines and name.
# Included by CMake it adds such sources to a target, run by `cmake -Doutput=FILE -P join.cmake -- SOURCE...` it writes
# one.

if(NOT CMAKE_SCRIPT_MODE_FILE)
  function(limpid_add_joined target count)
    set(together "")
    set(number 0)
    foreach(source IN LISTS ARGN)
      # What specializes a template of the library must stand outside of any namespace.
      file(STRINGS "${source}" outside REGEX "^(template <>|namespace limpid )" LIMIT_COUNT 1)
      if(outside OR count EQUAL 1)
        target_sources(${target} PRIVATE "${source}")
      else()
        list(APPEND together "${source}")
      endif()
    endforeach()
    cmake_path(GET ARGV2 PARENT_PATH folder)
    target_include_directories(${target} PRIVATE "${folder}")  # of what they include by quotes
    while(together)
      list(SUBLIST together 0 ${count} part)
      list(REMOVE_ITEM together ${part})
      math(EXPR number "${number} + 1")
      set(joined "${CMAKE_CURRENT_BINARY_DIR}/joined/${target}_${number}.cpp")
      add_custom_command(
        OUTPUT "${joined}"
        COMMAND "${CMAKE_COMMAND}" "-Doutput=${joined}" -P "${CMAKE_CURRENT_FUNCTION_LIST_FILE}" -- ${part}
        DEPENDS ${part} "${CMAKE_CURRENT_FUNCTION_LIST_FILE}"
        COMMENT "Joining tests" VERBATIM)
      target_sources(${target} PRIVATE "${joined}")
    endwhile()
  endfunction()
  return()
endif()

cmake_minimum_required(VERSION 3.25)

set(includes "")
set(bodies "")
math(EXPR last "${CMAKE_ARGC} - 1")
foreach(i RANGE 5 ${last})  # cmake -D -P join.cmake --
  set(source "${CMAKE_ARGV${i}}")
  file(READ "${source}" text)
  string(FIND "${text}" "\n#include" begin REVERSE)
  math(EXPR begin "${begin} + 1")
  string(SUBSTRING "${text}" ${begin} -1 rest)
  string(FIND "${rest}" "\n" length)
  math(EXPR end "${begin} + ${length} + 1")
  string(SUBSTRING "${text}" 0 ${end} head)
  string(SUBSTRING "${text}" ${end} -1 body)
  string(REGEX REPLACE "[^\n]" "" newlines "${head}")
  string(LENGTH "${newlines}" line)
  math(EXPR line "${line} + 1")
  cmake_path(GET source STEM name)
  string(APPEND includes "${head}")
  string(APPEND bodies "\nnamespace ${name} {\n#line ${line} \"${source}\"\n${body}}\n")
endforeach()
file(WRITE "${output}" "${includes}${bodies}")
