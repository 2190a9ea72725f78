# nplc_test(NAME SOURCES ... DEPENDS ... [TIER quick|full])
#
# Makes program test_NAME of GoogleTest cases and gives every case to CTest as NAME.Suite.Case. Tier `quick` (the
# default) is what one runs while working; `full` cases run in the full test run only.

find_package(GTest)
if(NOT GTest_FOUND)
  message(FATAL_ERROR "GoogleTest is missing. Run tools/setup, or build without the tests: -DNPLC_TESTS=OFF")
endif()
include(GoogleTest)

function(nplc_test name)
  cmake_parse_arguments(ARG "" "TIER" "SOURCES;DEPENDS" ${ARGN})
  if(NOT ARG_TIER)
    set(ARG_TIER quick)
  endif()
  add_executable(test_${name} ${ARG_SOURCES})
  target_link_libraries(test_${name} PRIVATE ${ARG_DEPENDS} nplc_options GTest::gtest_main)
  set_target_properties(test_${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/tests")
  gtest_discover_tests(test_${name} TEST_PREFIX "${name}." DISCOVERY_MODE PRE_TEST
    PROPERTIES LABELS ${ARG_TIER} TIMEOUT 600)
endfunction()
