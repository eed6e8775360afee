# Configures a copy of the lists, with one more file `forgotten` if given, and compares CMake's message with `expected`.
file(REMOVE_RECURSE ${work})
file(GLOB_RECURSE headers RELATIVE ${source}/lib ${source}/lib/shearfront/flux/*.hpp
     ${source}/lib/shearfront/shear_rate/*.hpp ${source}/lib/shearfront/*solver.hpp
     ${source}/lib/shearfront/solver/all.hpp)
foreach(header IN LISTS headers)
  configure_file(${source}/lib/${header} ${work}/${header} COPYONLY)
endforeach()
if(forgotten)
  file(WRITE ${work}/${forgotten} "#pragma once\n")
endif()
file(WRITE ${work}/CMakeLists.txt "
cmake_minimum_required(VERSION 3.25)
project(lists LANGUAGES NONE)
include(${source}/cmake/check_lists.cmake)
shearfront_check_list(shearfront/flux)
shearfront_check_list(shearfront/shear_rate)
shearfront_check_solvers()
")
execute_process(COMMAND ${CMAKE_COMMAND} -G ${generator} -S ${work} -B ${work}/build RESULT_VARIABLE code OUTPUT_QUIET
                ERROR_VARIABLE message)
if(NOT expected)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "the lists as they are were refused:\n${message}")
  endif()
  return()
endif()
string(REGEX REPLACE "[ \n]+" " " one_line "${message}")  # CMake breaks long messages
string(FIND "${one_line}" "${expected}" found)
if(code EQUAL 0 OR found EQUAL -1)
  message(FATAL_ERROR "expected a failure with\n  ${expected}\nbut exit code ${code} and\n${message}")
endif()
