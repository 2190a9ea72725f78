# The whole firmware for a board without an operating system, as .elf, .bin, .hex and .map, and its size report.
#
#   nplc_image(BOARD SOURCES ... LINKER_SCRIPT F BUDGETS ... STACK BYTES)
#
# BUDGETS are options of sizes.py. STACK is the size reserved by the linker script without the unpainted part.
# The RAM count leaves out the table and the event log, which are data; the stack counts as computed.
include(NplcPython)
find_package(Python3 REQUIRED COMPONENTS Interpreter)
include(NplcCommit)
set(NPLC_BOARDS "${CMAKE_CURRENT_LIST_DIR}")
set(record_bytes 0)
if(NPLC_SET_POINTS)
  set(record_bytes 1024)
endif()
math(EXPR table_bytes "(1024 + 1) * 8 + ${record_bytes} + 40")
set(NPLC_NOT_COUNTED --not-counted "table=${table_bytes}" --not-counted "event log=128")

function(nplc_image board)
  cmake_parse_arguments(ARG "" "LINKER_SCRIPT;STACK" "SOURCES;BUDGETS" ${ARGN})
  get_property(core_modules GLOBAL PROPERTY NPLC_CORE_MODULES)
  set(script "${CMAKE_CURRENT_SOURCE_DIR}/${ARG_LINKER_SCRIPT}")
  set(shared "${NPLC_BOARDS}/bare_metal")
  set(name "nanoplc_${board}")
  set(image "${CMAKE_BINARY_DIR}/bin/${name}")

  add_executable(${name} ${ARG_SOURCES})
  set(variant "")
  foreach(part SET_POINTS MODBUS)
    if(NPLC_${part})
      string(TOLOWER "+${part}" part)
      string(APPEND variant "${part}")
    endif()
  endforeach()
  nplc_commit_source(${name} "${shared}/image_name.cpp.in" "IMAGE=${board}${variant}" "VERSION=${PROJECT_VERSION}")
  set_target_properties(${name} PROPERTIES SUFFIX .elf LINK_DEPENDS "${script};${shared}/sections.ld")
  target_link_libraries(${name} PRIVATE ${core_modules} nplc_options)
  target_link_options(${name} PRIVATE -nostartfiles "-T${script}" "-L${shared}" "-Wl,-Map=${image}.map" -fcallgraph-info=su)
  add_custom_command(TARGET ${name} POST_BUILD
    COMMAND "${CMAKE_OBJCOPY}" -O binary "${image}.elf" "${image}.bin"
    COMMAND "${CMAKE_OBJCOPY}" -O ihex "${image}.elf" "${image}.hex"
    BYPRODUCTS "${image}.bin" "${image}.hex" "${image}.map" "${image}.elf.ltrans0.ltrans.ci" VERBATIM)

  add_custom_target(size_report ALL
    COMMAND Python3::Interpreter "${NPLC_BOARDS}/stack.py" "${image}.elf.ltrans0.ltrans.ci" --board ${board}
            --at-most ${ARG_STACK} > "${image}.stack"
    COMMAND Python3::Interpreter "${NPLC_BOARDS}/sizes.py" "${image}.elf" "${image}.bin" ${ARG_BUDGETS}
            --stack "${image}.stack" ${NPLC_NOT_COUNTED}
    DEPENDS ${name}
    COMMENT "Size of the firmware (${board}, ${NPLC_CPU}, ${CMAKE_BUILD_TYPE}), bytes"
    USES_TERMINAL VERBATIM)
endfunction()
