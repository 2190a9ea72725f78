# nplc_test(NAME SOURCES ... DEPENDS ... [TIER quick|full] [FAST])
#
# Makes program test_NAME of GoogleTest cases and gives every case to CTest as NAME.Suite.Case; with sanitizers, where
# each start takes long, all of them as one test NAME. Tier `quick` (the default) is what one runs while working; `full`
# cases run in the full test run only. Tests are optimised little, which halves the time to compile them; FAST ones,
# which compute much themselves, are optimised as the rest is. Built for another processor they are no tests of CTest's:
# tests/emulated runs them.

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
target_compile_options(nplc_test_headers PRIVATE $<$<CONFIG:Release>:-O1> -fpch-preprocess)

add_custom_target(unit_tests)

function(nplc_test name)
  cmake_parse_arguments(ARG "FAST" "TIER" "SOURCES;DEPENDS" ${ARGN})
  if(NOT ARG_TIER)
    set(ARG_TIER quick)
  endif()
  add_executable(test_${name} ${ARG_SOURCES})
  target_link_libraries(test_${name} PRIVATE ${ARG_DEPENDS} nplc_options GTest::gtest_main)
  if(NOT ARG_FAST)
    target_compile_options(test_${name} PRIVATE $<$<CONFIG:Release>:-O1> -fpch-preprocess)
    target_precompile_headers(test_${name} REUSE_FROM nplc_test_headers)
  endif()
  set_target_properties(test_${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/tests")
  add_dependencies(unit_tests test_${name})
  if(CMAKE_CROSSCOMPILING)
    return()
  endif()
  if(NPLC_SANITIZE)
    add_test(NAME ${name} COMMAND test_${name} --gtest_brief=1)
    set_tests_properties(${name} PROPERTIES LABELS ${ARG_TIER} TIMEOUT 1200)
    return()
  endif()
  gtest_discover_tests(test_${name} TEST_PREFIX "${name}." DISCOVERY_MODE PRE_TEST NO_PRETTY_VALUES
    PROPERTIES LABELS ${ARG_TIER} TIMEOUT 600)
endfunction()
