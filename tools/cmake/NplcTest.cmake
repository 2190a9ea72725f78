# nplc_test(NAME SOURCES ... DEPENDS ... [PART part] [FAST] [OWN_HEADERS])
#
# Makes program test_NAME of GoogleTest cases and gives every case to CTest as NAME.Suite.Case; with sanitizers, where
# each start takes long, all of them as two tests NAME.1 and NAME.2. PART is the part of the full run (tests/README.md) that it
# belongs to: `gate` if none is said, and `realtime` in its place where the sources depend on when something happens. Tests are
# optimised little, which halves the time to compile them; FAST ones, which compute much themselves, are optimised as the rest is.
# OWN_HEADERS: without the precompiled headers, as other options of the compiler ask for.
# Built for another processor they are no tests of CTest's: tests/emulated runs them.

# Parts run a test a core. What builds, or must not share the machine, says PROCESSORS ${NPLC_ALL_PLACES}.
cmake_host_system_information(RESULT cores QUERY NUMBER_OF_LOGICAL_CORES)
set(NPLC_CORE 1)
set(NPLC_PARTS 2)  # of a test program with sanitizers
set(NPLC_ALL_PLACES ${cores})

include(NplcPython)
find_package(Python3 REQUIRED COMPONENTS Interpreter)

execute_process(COMMAND "${Python3_EXECUTABLE}" -B "${PROJECT_SOURCE_DIR}/tools/cmake/real_time.py" "${PROJECT_SOURCE_DIR}/tests"
                OUTPUT_VARIABLE NPLC_REAL_TIME_SOURCES OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
string(REPLACE "\n" ";" NPLC_REAL_TIME_SOURCES "${NPLC_REAL_TIME_SOURCES}")

# nplc_part(RESULT PART SOURCE...)
#
# PART, or `realtime` if PART is `gate` or `thorough` and the sources depend on when something happens.
function(nplc_part result part)
  if(part STREQUAL "gate" OR part STREQUAL "thorough")
    foreach(source IN LISTS ARGN)
      cmake_path(ABSOLUTE_PATH source NORMALIZE)
      if(source IN_LIST NPLC_REAL_TIME_SOURCES)
        set(part realtime)
      endif()
    endforeach()
  endif()
  set(${result} ${part} PARENT_SCOPE)
endfunction()

# nplc_properties_of_part(RESULT PART)
#
# The verdict of the gate must not depend on speed: its limit ends what hangs, nothing else. Tests in real time, which are in two
# parts, run one at a time.
function(nplc_properties_of_part result part)
  set(properties LABELS ${part} TIMEOUT 900)
  if(part STREQUAL "gate" OR part STREQUAL "thorough")
    set(properties LABELS ${part} TIMEOUT 1800)
  elseif(part MATCHES "^(realtime|terminals)$")
    set(properties LABELS ${part} TIMEOUT 900 RESOURCE_LOCK real_time)
  elseif(part STREQUAL "long")
    set(properties LABELS ${part} TIMEOUT 7200)
  endif()
  set(${result} ${properties} PARENT_SCOPE)
endfunction()

find_package(GTest)
if(NOT GTest_FOUND)
  message(FATAL_ERROR "GoogleTest is missing. Run tools/setup, or build without the tests: -DNPLC_TESTS=OFF")
endif()
include(GoogleTest)

# What nearly every test includes, compiled once for each optimisation.
set(headers <gtest/gtest.h> <algorithm> <array> <chrono> <cstdint> <deque>
    <functional> <map> <optional> <set> <span> <string> <string_view> <vector>)
set(NPLC_TEST_OPTIONS $<$<CONFIG:Release>:-Og>)
nplc_common_headers(test_headers LIBRARIES GTest::gtest HEADERS ${headers} OPTIONS ${NPLC_TEST_OPTIONS})
set(NPLC_FAST_TEST_HEADERS test_headers)
if(CMAKE_BUILD_TYPE STREQUAL "Release")
  set(NPLC_FAST_TEST_HEADERS fast_test_headers)
  nplc_common_headers(fast_test_headers LIBRARIES GTest::gtest HEADERS ${headers})
endif()

# gold links a test in half the time. What is shipped is linked with the system's own linker.
find_program(NPLC_GOLD ld.gold DOC "Linker of the tests")
set(NPLC_TEST_LINKER "")
if(NPLC_GOLD AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND NOT CMAKE_CROSSCOMPILING AND NOT NPLC_SANITIZE)
  set(NPLC_TEST_LINKER -fuse-ld=gold)
endif()

add_custom_target(unit_tests)

function(nplc_test name)
  cmake_parse_arguments(ARG "FAST;OWN_HEADERS" "PART" "SOURCES;DEPENDS" ${ARGN})
  if(NOT ARG_PART)
    set(ARG_PART gate)
  endif()
  add_executable(test_${name} ${ARG_SOURCES})
  target_link_libraries(test_${name} PRIVATE ${ARG_DEPENDS} nplc_options GTest::gtest_main)
  target_link_options(test_${name} PRIVATE ${NPLC_TEST_LINKER})
  set(headers ${NPLC_FAST_TEST_HEADERS})
  if(NOT ARG_FAST)
    target_compile_options(test_${name} PRIVATE ${NPLC_TEST_OPTIONS})
    set(headers test_headers)
  endif()
  if(NOT ARG_OWN_HEADERS)
    nplc_use_common_headers(test_${name} ${headers})
  endif()
  nplc_compile_together(test_${name})
  set_target_properties(test_${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/tests")
  add_dependencies(unit_tests test_${name})
  if(CMAKE_CROSSCOMPILING)
    return()
  endif()
  nplc_part(part ${ARG_PART} ${ARG_SOURCES})
  nplc_properties_of_part(properties ${part})
  if(NPLC_SANITIZE)
    foreach(shard RANGE 1 ${NPLC_PARTS})
      math(EXPR index "${shard} - 1")
      add_test(NAME ${name}.${shard} COMMAND test_${name} --gtest_brief=1)
      set_tests_properties(${name}.${shard} PROPERTIES ${properties} TIMEOUT 1800
                           ENVIRONMENT "GTEST_TOTAL_SHARDS=${NPLC_PARTS};GTEST_SHARD_INDEX=${index}")
    endforeach()
    return()
  endif()
  gtest_discover_tests(test_${name} TEST_PREFIX "${name}." DISCOVERY_MODE PRE_TEST DISCOVERY_TIMEOUT 1800 NO_PRETTY_VALUES
    PROPERTIES ${properties})
endfunction()

# nplc_script_test(NAME SCRIPT [ARGUMENT...] [PART part] [SPLIT])
#
# Gives tests/FOLDER/SCRIPT.py ARGUMENT... to CTest as NAME; PART as above. SPLIT: each of its cases as a test of its own,
# NAME.Class.test, named to the script behind its arguments.
function(nplc_script_test name script)
  cmake_parse_arguments(ARG "SPLIT" "PART" "" ${ARGN})
  if(NOT ARG_PART)
    set(ARG_PART gate)
  endif()
  set(path "${CMAKE_CURRENT_SOURCE_DIR}/${script}.py")
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${path}")
  nplc_part(part ${ARG_PART} "${path}")
  nplc_properties_of_part(properties ${part})
  set(command Python3::Interpreter -B "${path}" ${ARG_UNPARSED_ARGUMENTS})
  if(NOT ARG_SPLIT)
    add_test(NAME ${name} COMMAND ${command})
    set_tests_properties(${name} PROPERTIES ${properties})
    return()
  endif()
  execute_process(COMMAND "${Python3_EXECUTABLE}" -B "${PROJECT_SOURCE_DIR}/tools/cmake/list_cases.py" "${path}"
                  OUTPUT_VARIABLE cases OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  string(REPLACE "\n" ";" cases "${cases}")
  foreach(case IN LISTS cases)
    add_test(NAME ${name}.${case} COMMAND ${command} ${case})
    set_tests_properties(${name}.${case} PROPERTIES ${properties})
  endforeach()
endfunction()
