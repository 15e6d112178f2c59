# SPDX-License-Identifier: MIT
# cmake -Droot=DIR -P rules.cmake: the licence line of every source, and what a public header may include.
cmake_minimum_required(VERSION 3.25)

# A folder of include/limpid may include itself, core, and these. Arrows never point back (docs: layout in README.md).
set(core_may_include "")
set(signal_may_include "")
set(environment_may_include signal)
set(estimation_may_include signal environment)
set(prediction_may_include signal environment estimation)
set(robot_may_include "")
set(control_may_include signal robot)
set(loop_may_include signal environment evaluation) # realtime/: samples of a tool elsewhere, histograms of latency
set(device_may_include signal robot control) # of control, what reaches the motors: SafeTorque
set(evaluation_may_include "")
set(design_may_include environment signal prediction control) # of prediction, the gains; of control, the observers
set(scene_may_include signal environment estimation prediction robot control loop device evaluation)

set(broken "")
macro(report file text)
  string(APPEND broken "${file}: ${text}\n")
endmacro()

file(GLOB_RECURSE sources RELATIVE "${root}" "${root}/include/*.hpp" "${root}/test/*.[ch]pp" "${root}/bench/*.[ch]pp"
     "${root}/examples/*.[ch]pp")
foreach(source IN LISTS sources)
  file(READ "${root}/${source}" text LIMIT 64)
  if(NOT text MATCHES "^// SPDX-License-Identifier: MIT\n")
    report("${source}" "expected its first line to be `// SPDX-License-Identifier: MIT`")
  endif()
endforeach()

file(STRINGS "${root}/include/limpid/limpid.hpp" umbrella REGEX "^#include")
file(GLOB_RECURSE headers RELATIVE "${root}/include/limpid" "${root}/include/limpid/*.hpp")
list(REMOVE_ITEM headers limpid.hpp)
foreach(header IN LISTS headers)
  set(name "include/limpid/${header}")
  file(STRINGS "${root}/${name}" guard REGEX "^#pragma once$")
  if(NOT guard)
    report("${name}" "expected `#pragma once`")
  endif()

  if(NOT header MATCHES "/(usb|serial)/" AND NOT "#include <limpid/${header}>" IN_LIST umbrella)
    report("${name}" "expected limpid.hpp to include it")
  endif()

  string(REGEX REPLACE "/.*" "" folder "${header}")
  file(STRINGS "${root}/${name}" includes REGEX "^ *# *include")
  foreach(line IN LISTS includes)
    string(REGEX REPLACE ".*[<\"](.*)[>\"].*" "\\1" included "${line}")
    if(included MATCHES "^limpid/([^/]*)")
      if(NOT DEFINED ${folder}_may_include)
        report("${name}" "expected a folder that test/rules.cmake knows")
      elseif(NOT "${CMAKE_MATCH_1}" IN_LIST ${folder}_may_include AND NOT CMAKE_MATCH_1 MATCHES "^(core|${folder})$")
        report("${name}" "${folder}/ may not include ${included}")
      endif()
    elseif(included MATCHES "^boost/" AND NOT folder STREQUAL "loop" AND NOT header MATCHES "^device/serial/")
      report("${name}" "only loop/ and device/serial/ may include Boost, got ${included}")
    elseif(included MATCHES "^(CLI|nlohmann|benchmark|doctest)/" OR line MATCHES "\"")
      report("${name}" "a public header may not include ${included}")
    endif()
  endforeach()
endforeach()

if(broken)
  message(FATAL_ERROR "\n${broken}")
endif()
