# The firmware of a board with a boot loader: two links of the same objects, one for each slot, a signed file
# with both, and the image for programming a new board.
#
#   nplc_update_image(BOARD ID N SOURCES ... LOADER F.cpp F.ld ADDRESSES A B SLOT_BYTES N
#                     STACK BYTES BUDGETS ...)
#
# The slots are linked by slot_0.ld and slot_1.ld. ADDRESSES are those of the slots in the chip.
include_guard(GLOBAL)
include(NplcPython)
find_package(Python3 REQUIRED COMPONENTS Interpreter)
include(NplcCommit)
set(NPLC_UPDATE_KEY "" CACHE FILEPATH "Private key that signs the firmware (openssl genpkey -algorithm ed25519); a new one without")
set(NPLC_SIGN_FIRMWARE "${PROJECT_SOURCE_DIR}/tools/sign_firmware")

function(_nplc_slot_image board slot)
  set(name "nanoplc_${board}_slot_${slot}")
  set(image "${CMAKE_BINARY_DIR}/bin/${name}")
  add_executable(${name} ${ARGN})
  nplc_commit_source(${name} "${NPLC_BOARDS}/bare_metal/image_name.cpp.in" "IMAGE=${board}_slot_${slot}" "VERSION=${PROJECT_VERSION}")
  get_property(core_modules GLOBAL PROPERTY NPLC_CORE_MODULES)
  set(script "${CMAKE_CURRENT_SOURCE_DIR}/slot_${slot}.ld")
  set_target_properties(${name} PROPERTIES SUFFIX .elf LINK_DEPENDS "${script};${NPLC_BOARDS}/bare_metal/sections.ld")
  target_link_libraries(${name} PRIVATE ${core_modules} nplc_options)
  target_link_options(${name} PRIVATE -nostartfiles "-T${script}" "-L${NPLC_BOARDS}/bare_metal" "-Wl,-Map=${image}.map" -fcallgraph-info=su)
  add_custom_command(TARGET ${name} POST_BUILD COMMAND "${CMAKE_OBJCOPY}" -O binary "${image}.elf" "${image}.bin"
    BYPRODUCTS "${image}.bin" "${image}.map" "${image}.elf.ltrans0.ltrans.ci" VERBATIM)
endfunction()

function(_nplc_loader board source script)
  set(name "nanoplc_${board}_loader")
  set(image "${CMAKE_BINARY_DIR}/bin/${name}")
  set(folder "${CMAKE_CURRENT_BINARY_DIR}/loader")
  add_custom_command(OUTPUT "${folder}/public_key.h"
    COMMAND Python3::Interpreter "${NPLC_SIGN_FIRMWARE}" header --key "${NPLC_SIGNING_KEY}" -o "${folder}/public_key.h"
    DEPENDS "${NPLC_SIGN_FIRMWARE}" "${NPLC_SIGNING_KEY}" VERBATIM)
  add_executable(${name} ${source} "${folder}/public_key.h")
  nplc_commit_source(${name} "${NPLC_BOARDS}/bare_metal/image_name.cpp.in" "IMAGE=${board}_loader" "VERSION=${PROJECT_VERSION}")
  target_include_directories(${name} PRIVATE "${folder}")
  get_property(core_modules GLOBAL PROPERTY NPLC_CORE_MODULES)
  set_target_properties(${name} PROPERTIES SUFFIX .elf
    LINK_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/${script};${NPLC_BOARDS}/bare_metal/sections.ld")
  target_link_libraries(${name} PRIVATE ${core_modules} nplc_options)
  target_link_options(${name} PRIVATE -nostartfiles "-T${CMAKE_CURRENT_SOURCE_DIR}/${script}" "-L${NPLC_BOARDS}/bare_metal"
                      "-Wl,-Map=${image}.map" -Wl,--print-memory-usage)
  add_custom_command(TARGET ${name} POST_BUILD COMMAND "${CMAKE_OBJCOPY}" -O binary "${image}.elf" "${image}.bin"
    BYPRODUCTS "${image}.bin" "${image}.map" VERBATIM)
endfunction()

function(nplc_update_image board)
  cmake_parse_arguments(ARG "" "ID;STACK;SLOT_BYTES" "SOURCES;BUDGETS;LOADER;ADDRESSES" ${ARGN})
  set(NPLC_SIGNING_KEY "${NPLC_UPDATE_KEY}")
  if(NOT NPLC_SIGNING_KEY)
    set(NPLC_SIGNING_KEY "${CMAKE_BINARY_DIR}/development_key.pem")
    if(NOT EXISTS "${NPLC_SIGNING_KEY}")
      execute_process(COMMAND openssl genpkey -algorithm ed25519 -out "${NPLC_SIGNING_KEY}" COMMAND_ERROR_IS_FATAL ANY)
    endif()
    message(STATUS "The firmware is signed with ${NPLC_SIGNING_KEY}, for development; NPLC_UPDATE_KEY names your own")
  endif()
  set(bin "${CMAKE_BINARY_DIR}/bin/nanoplc_${board}")
  _nplc_slot_image(${board} 0 ${ARG_SOURCES})
  _nplc_slot_image(${board} 1 ${ARG_SOURCES})
  _nplc_loader(${board} ${ARG_LOADER})

  list(GET ARG_ADDRESSES 0 first)
  list(GET ARG_ADDRESSES 1 second)
  add_custom_target(firmware_file ALL
    COMMAND Python3::Interpreter "${NPLC_SIGN_FIRMWARE}" sign --key "${NPLC_SIGNING_KEY}" --board ${ARG_ID}
            --version ${PROJECT_VERSION} "${first}=${bin}_slot_0.bin" "${second}=${bin}_slot_1.bin" -o "${bin}.npfw"
    COMMAND Python3::Interpreter "${NPLC_SIGN_FIRMWARE}" factory --loader "${bin}_loader.bin" --slot-bytes ${ARG_SLOT_BYTES}
            "${bin}.npfw" -o "${bin}.hex"
    BYPRODUCTS "${bin}.npfw" "${bin}.hex"
    DEPENDS nanoplc_${board}_slot_0 nanoplc_${board}_slot_1 nanoplc_${board}_loader VERBATIM)

  set(image "${bin}_slot_0")
  add_custom_target(size_report ALL
    COMMAND Python3::Interpreter "${NPLC_BOARDS}/stack.py" "${image}.elf.ltrans0.ltrans.ci" --board ${board}
            --at-most ${ARG_STACK} > "${image}.stack"
    COMMAND Python3::Interpreter "${NPLC_BOARDS}/sizes.py" "${image}.elf" "${image}.bin" ${ARG_BUDGETS}
            --stack "${image}.stack" ${NPLC_NOT_COUNTED}
    DEPENDS nanoplc_${board}_slot_0
    COMMENT "Size of the firmware (${board}, with NPLC_UPDATE), bytes" USES_TERMINAL VERBATIM)
endfunction()
