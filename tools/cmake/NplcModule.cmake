# Compiler settings and the two ways to make a folder into a target.
#
#   nplc_core_module(NAME SOURCES ... DEPENDS ...)   firmware code: no exceptions, no RTTI, no heap
#   nplc_host_module(NAME SOURCES ... DEPENDS ...)   tools and simulation: ordinary C++, with fmt
#     BUSY          optimised with the sanitizers too
#     OWN_HEADERS   without the common precompiled headers, as another optimisation asks for
#
# Each makes library nplc_NAME whose only public include path is the folder's own include/, so a folder can
# include only what it names under DEPENDS.

set(CMAKE_CXX_STANDARD 23)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/bin")

option(NPLC_WERROR "Treat warnings as errors (of g++ 12 and clang 14; others may know more of them)" ON)
option(NPLC_SANITIZE "Build with AddressSanitizer and UndefinedBehaviorSanitizer" OFF)
option(NPLC_TESTS "Build the tests" ON)
option(NPLC_BOARD_TESTS "Build the tests that run on the virtual board of tests/vm" OFF)
option(NPLC_STATIC "Link programs statically, and strip them" OFF)
option(NPLC_COVERAGE "Count the lines and branches of the core that run (tools/coverage)" OFF)
option(NPLC_FUZZ "Build the libFuzzer targets (needs clang)" OFF)
option(NPLC_UNITY "Compile several files of a tool or a test at once: half the time for a build from nothing" ON)
option(NPLC_DEMO "Only seqc and nanoplc-sim, and of them what tools/demo runs (NplcDemo.cmake)" OFF)
option(NPLC_COMMON_HEADERS "Compile what most host files include once (g++ only)" ON)

# A second checkout finds what the first one compiled. Precompiled headers need the two sloppinesses. Reports of stack use
# and coverage name files as the compiler was given them: those builds go without.
find_program(NPLC_CCACHE ccache)
if(NPLC_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER AND NOT CMAKE_SYSTEM_NAME STREQUAL "Generic" AND NOT NPLC_COVERAGE)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${CMAKE_COMMAND}" -E env "CCACHE_BASEDIR=${PROJECT_SOURCE_DIR}"
                                  CCACHE_SLOPPINESS=pch_defines,time_macros "${NPLC_CCACHE}")
endif()

if(CMAKE_SYSTEM_NAME STREQUAL "Generic")
  set(NPLC_HOSTED OFF)
else()
  set(NPLC_HOSTED ON)
endif()

# Hosts always keep set-points.
if(NOT NPLC_HOSTED)
  option(NPLC_SET_POINTS "Keep set-points, 16 values and 4 recipes: up to 4 KiB of flash and 4 KiB of RAM more" OFF)
  option(NPLC_MODBUS "Speak Modbus RTU beside MacTalk on the user's port: up to 4 KiB of flash and 1 KiB of RAM more" OFF)
  option(NPLC_UPDATE "Renew the firmware over the user's port, with a loader and two slots" OFF)
  add_compile_definitions(NPLC_UPDATE=$<BOOL:${NPLC_UPDATE}>)
  add_compile_definitions(NPLC_SET_POINTS=$<BOOL:${NPLC_SET_POINTS}> NPLC_RECIPES=4 NPLC_MODBUS=$<BOOL:${NPLC_MODBUS}>
                          NPLC_LATE_LINES=0 NPLC_STORE_TRACES=0)
endif()

add_library(nplc_options INTERFACE)
target_compile_options(nplc_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wold-style-cast -Wnon-virtual-dtor
  -Wimplicit-fallthrough -Wdouble-promotion -Wundef)
# g++ 12 raises these falsely inside its own std::vector and std::string when it optimises. The core is still held to
# them in the microcontroller's build.
if(NPLC_HOSTED AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(nplc_options INTERFACE -Wno-array-bounds -Wno-free-nonheap-object -Wno-restrict
                                                -Wno-stringop-overflow -Wno-stringop-overread)
endif()
# A three-stage pipeline gains little from instruction scheduling or jump threading, which would cost 400
# bytes of flash.
if(NOT NPLC_HOSTED)
  target_compile_options(nplc_options INTERFACE -fno-schedule-insns2 -fno-reorder-blocks -fno-move-loop-invariants
                                                -fno-tree-dominator-opts)
endif()
if(NPLC_WERROR AND CMAKE_CXX_COMPILER_VERSION MATCHES "^(12|14)\\.")
  target_compile_options(nplc_options INTERFACE -Werror)
endif()
if(NPLC_STATIC)
  set(CMAKE_FIND_LIBRARY_SUFFIXES ".a")
  add_link_options(-static -s)
endif()
if(NPLC_SANITIZE)
  # A part that goes into a library (host-sim/fmu) reaches the sanitizers' own data as that of another library.
  string(TOUPPER "${CMAKE_BUILD_TYPE}" configuration)
  string(APPEND CMAKE_CXX_FLAGS_${configuration} " -fPIC")
  target_compile_options(nplc_options INTERFACE -fno-semantic-interposition)
  target_compile_options(nplc_options INTERFACE -fsanitize=address,undefined -fno-sanitize=vptr -fno-sanitize-recover=all
                                                -fno-omit-frame-pointer)
  # With them g++ 12 says falsely that (byte >> n) & 1U changes a sign. The release build holds the sources to it.
  target_compile_options(nplc_options INTERFACE -Wno-sign-conversion)
  target_link_options(nplc_options INTERFACE -fsanitize=address,undefined)
endif()
if(NPLC_FUZZ)
  target_compile_options(nplc_options INTERFACE -fsanitize=fuzzer-no-link,address,undefined -fno-sanitize=vptr
                                                -fno-sanitize-recover=all)
  target_link_options(nplc_options INTERFACE -fsanitize=address,undefined)
endif()
if(NPLC_COVERAGE)
  target_link_options(nplc_options INTERFACE --coverage)
  set(NPLC_CORE_COVERAGE --coverage -O0 -fprofile-update=atomic)
endif()

# The core is compiled file by file for microcontrollers, with the sanitizers, and where each file's lines or branches count.
set(NPLC_CORE_TOGETHER ON)
if(NOT NPLC_HOSTED OR NPLC_SANITIZE OR NPLC_COVERAGE OR NPLC_FUZZ)
  set(NPLC_CORE_TOGETHER OFF)
endif()

# Whole machines run for minutes of virtual time in the tests: what they consist of is optimised with the sanitizers too.
if(NPLC_SANITIZE)
  set(NPLC_BUSY_OPTIONS -O2)
endif()

set(NPLC_TOGETHER 10)  # files
if(NPLC_DEMO)
  include(NplcDemo)
endif()

# Files of the core, and with NPLC_DEMO of any module, with names that collide with their neighbours'; and families.cpp, which
# tests/families has in another form.
set(NPLC_ALONE "^([a-z]+/)?(claims|constants|families|fields_small|jvl_family|mac800|machine|midi_can_link|midi_family|motor_memory|plant|scale|settings_manager|standstill|titles_small|write)\\.cpp$")

function(_nplc_module name)
  cmake_parse_arguments(ARG "CORE" "" "SOURCES;DEPENDS;OPTIONS" ${ARGN})
  if(NPLC_DEMO)
    nplc_demo_part(${name} ARG_SOURCES)
  endif()
  if(NPLC_DEMO OR ARG_CORE)
    set(alone ${ARG_SOURCES})
    list(FILTER alone INCLUDE REGEX "${NPLC_ALONE}")
    set_source_files_properties(${alone} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  endif()
  if(ARG_SOURCES)
    add_library(nplc_${name} STATIC ${ARG_SOURCES})
    target_include_directories(nplc_${name} PUBLIC include PRIVATE .)
    target_link_libraries(nplc_${name} PUBLIC ${ARG_DEPENDS} PRIVATE nplc_options)
    target_compile_options(nplc_${name} PRIVATE ${ARG_OPTIONS})
  else()
    add_library(nplc_${name} INTERFACE)
    target_include_directories(nplc_${name} INTERFACE include)
    target_link_libraries(nplc_${name} INTERFACE ${ARG_DEPENDS})
  endif()
endfunction()

function(nplc_core_module name)
  _nplc_module(${name} CORE ${ARGN} OPTIONS -fno-exceptions -fno-rtti ${NPLC_BUSY_OPTIONS} ${NPLC_CORE_COVERAGE})
  set_property(GLOBAL APPEND PROPERTY NPLC_CORE_MODULES nplc_${name})
  get_target_property(type nplc_${name} TYPE)
  if(NPLC_CORE_TOGETHER AND type STREQUAL "STATIC_LIBRARY")
    nplc_compile_together(nplc_${name})
  endif()
endfunction()

# nplc_common_headers(NAME HEADERS ... [LIBRARIES ...] [OPTIONS ...])
#
# Compiles HEADERS once, for every target given to nplc_use_common_headers(TARGET NAME). Its optimisation must be theirs.
function(nplc_common_headers name)
  cmake_parse_arguments(ARG "" "" "HEADERS;LIBRARIES;OPTIONS" ${ARGN})
  set(source "${CMAKE_BINARY_DIR}/common_headers/${name}.cpp")
  file(CONFIGURE OUTPUT "${source}" CONTENT "")
  add_library(nplc_${name} OBJECT "${source}")
  target_link_libraries(nplc_${name} PRIVATE nplc_options ${ARG_LIBRARIES})
  target_compile_options(nplc_${name} PRIVATE ${ARG_OPTIONS} -fpch-preprocess)
  target_precompile_headers(nplc_${name} PRIVATE ${ARG_HEADERS})
endfunction()

function(nplc_use_common_headers target name)
  if(TARGET nplc_${name})
    target_compile_options(${target} PRIVATE -fpch-preprocess)
    target_precompile_headers(${target} REUSE_FROM nplc_${name})
  endif()
endfunction()

if(NPLC_HOSTED)
  find_package(fmt REQUIRED)
endif()
if(NPLC_HOSTED AND NPLC_COMMON_HEADERS AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  nplc_common_headers(host_headers LIBRARIES fmt::fmt
    HEADERS <fmt/format.h> <algorithm> <array> <charconv> <cstdint> <functional> <map> <memory> <optional> <set>
            <span> <string> <string_view> <utility> <vector>)
endif()

# Files that are small and include much cost more to read than to compile.
function(nplc_compile_together target)
  if(NPLC_UNITY)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${NPLC_TOGETHER})
  endif()
endfunction()

function(nplc_host_module name)
  cmake_parse_arguments(ARG "OWN_HEADERS;BUSY" "" "" ${ARGN})
  if(ARG_BUSY AND NPLC_SANITIZE)
    set(ARG_OWN_HEADERS ON)
    list(APPEND ARG_UNPARSED_ARGUMENTS OPTIONS ${NPLC_BUSY_OPTIONS})
  endif()
  _nplc_module(${name} ${ARG_UNPARSED_ARGUMENTS})
  get_target_property(type nplc_${name} TYPE)
  if(type STREQUAL "STATIC_LIBRARY")
    target_link_libraries(nplc_${name} PRIVATE fmt::fmt)
    nplc_compile_together(nplc_${name})
  endif()
  if(type STREQUAL "STATIC_LIBRARY" AND NOT ARG_OWN_HEADERS)
    nplc_use_common_headers(nplc_${name} host_headers)
  endif()
endfunction()
