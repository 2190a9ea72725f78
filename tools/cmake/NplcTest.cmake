# nplc_test(NAME SOURCES ... DEPENDS ... [TIER quick|full] [FAST])
#
# Makes program test_NAME of GoogleTest cases and gives every case to CTest as NAME.Suite.Case; with sanitizers, where
# each start takes long, all of them as two tests NAME.1 and NAME.2. Tier `quick` (the default) is what one runs while working; `full`
# cases run in the full test run only. Tests are optimised little, which halves the time to compile them; FAST ones,
# which compute much themselves, are optimised as the rest is, and begin first, so that none is left alone at the end. Built for another processor they are no tests of CTest's:
# tests/emulated runs them.

# tools/test runs four tests a core, since many wait for real time. What computes all the time says PROCESSORS, what builds
# with all cores ${NPLC_ALL_PLACES}.
cmake_host_system_information(RESULT cores QUERY NUMBER_OF_LOGICAL_CORES)
set(NPLC_CORE 4)
set(NPLC_PARTS 2)  # of a test program with sanitizers
set(NPLC_LONG_FIRST 200)  # COST of what computes for long
math(EXPR NPLC_ALL_PLACES "${NPLC_CORE} * ${cores}")

find_package(GTest)
if(NOT GTest_FOUND)
  message(FATAL_ERROR "GoogleTest is missing. Run tools/setup, or build without the tests: -DNPLC_TESTS=OFF")
endif()
include(GoogleTest)

# What nearly every test includes, compiled once.
file(CONFIGURE OUTPUT "${CMAKE_BINARY_DIR}/tests/common_headers.cpp" CONTENT "")
add_library(nplc_test_headers OBJECT "${CMAKE_BINARY_DIR}/tests/common_headers.cpp")
target_link_libraries(nplc_test_headers PRIVATE nplc_options GTest::gtest)
target_precompile_headers(nplc_test_headers PRIVATE <gtest/gtest.h> <algorithm> <array> <chrono> <cstdint> <deque>
  <functional> <map> <optional> <set> <span> <string> <string_view> <vector>)
target_compile_options(nplc_test_headers PRIVATE $<$<CONFIG:Release>:-Og> -fpch-preprocess)

add_custom_target(unit_tests)

function(nplc_test name)
  cmake_parse_arguments(ARG "FAST" "TIER" "SOURCES;DEPENDS" ${ARGN})
  if(NOT ARG_TIER)
    set(ARG_TIER quick)
  endif()
  add_executable(test_${name} ${ARG_SOURCES})
  target_link_libraries(test_${name} PRIVATE ${ARG_DEPENDS} nplc_options GTest::gtest_main)
  if(NOT ARG_FAST)
    target_compile_options(test_${name} PRIVATE $<$<CONFIG:Release>:-Og> -fpch-preprocess)
    target_precompile_headers(test_${name} REUSE_FROM nplc_test_headers)
  endif()
  nplc_compile_together(test_${name})
  set_target_properties(test_${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/tests")
  add_dependencies(unit_tests test_${name})
  if(CMAKE_CROSSCOMPILING)
    return()
  endif()
  set(cost 0)
  if(ARG_FAST OR ARG_TIER STREQUAL "full")
    set(cost ${NPLC_LONG_FIRST})
  endif()
  if(NPLC_SANITIZE)
    foreach(part RANGE 1 ${NPLC_PARTS})
      math(EXPR index "${part} - 1")
      add_test(NAME ${name}.${part} COMMAND test_${name} --gtest_brief=1)
      set_tests_properties(${name}.${part} PROPERTIES LABELS ${ARG_TIER} TIMEOUT 1200 COST ${cost}
                           ENVIRONMENT "GTEST_TOTAL_SHARDS=${NPLC_PARTS};GTEST_SHARD_INDEX=${index}")
    endforeach()
    return()
  endif()
  gtest_discover_tests(test_${name} TEST_PREFIX "${name}." DISCOVERY_MODE PRE_TEST NO_PRETTY_VALUES
    PROPERTIES LABELS ${ARG_TIER} TIMEOUT 600 COST ${cost})
endfunction()

# nplc_script_test(NAME SCRIPT [ARGUMENT...] [TIER quick|full] [SPLIT])
#
# Gives tests/FOLDER/SCRIPT.py ARGUMENT... to CTest as NAME. SPLIT: each of its cases as a test of its own,
# NAME.Class.test, named to the script behind its arguments. Those wait most of their time, so they begin early.
function(nplc_script_test name script)
  cmake_parse_arguments(ARG "SPLIT" "TIER" "" ${ARGN})
  if(NOT ARG_TIER)
    set(ARG_TIER quick)
  endif()
  set(path "${CMAKE_CURRENT_SOURCE_DIR}/${script}.py")
  set(command Python3::Interpreter -B "${path}" ${ARG_UNPARSED_ARGUMENTS})
  if(NOT ARG_SPLIT)
    add_test(NAME ${name} COMMAND ${command})
    set_tests_properties(${name} PROPERTIES LABELS ${ARG_TIER} TIMEOUT 600)
    return()
  endif()
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${path}")
  execute_process(COMMAND "${Python3_EXECUTABLE}" -B "${PROJECT_SOURCE_DIR}/tools/cmake/list_cases.py" "${path}"
                  OUTPUT_VARIABLE cases OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  string(REPLACE "\n" ";" cases "${cases}")
  foreach(case IN LISTS cases)
    add_test(NAME ${name}.${case} COMMAND ${command} ${case})
    set_tests_properties(${name}.${case} PROPERTIES LABELS ${ARG_TIER} TIMEOUT 600 COST 100)
  endforeach()
endfunction()
