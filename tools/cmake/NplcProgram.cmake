# nplc_program(NAME SOURCES ... DEPENDS ...)       a program with a command line
# nplc_command_line_module(NAME SOURCES ... DEPENDS ...)   a library that reads one
# nplc_program_documents(NAME [SECTION 8])
#
# The last installs program NAME with the manual page and the completions that it prints of itself (tools/command_line).
include_guard(GLOBAL)
include(GNUInstallDirs)
find_package(nlohmann_json REQUIRED)

# Reading a command line need not be fast; the libraries' headers take twice as long to compile with -O2.
set(NPLC_PROGRAM_OPTIONS $<$<CONFIG:Release>:-O1>)
set(NPLC_PROGRAM_HEADERS program_headers)
if(NPLC_DEMO)
  set(NPLC_PROGRAM_HEADERS host_headers)
elseif(TARGET nplc_host_headers)
  nplc_common_headers(program_headers LIBRARIES fmt::fmt nlohmann_json::nlohmann_json
    OPTIONS ${NPLC_PROGRAM_OPTIONS}
    HEADERS <fmt/format.h> <nlohmann/json.hpp>)
endif()

function(nplc_command_line_module name)
  nplc_host_module(${name} OWN_HEADERS ${ARGN})
  target_link_libraries(nplc_${name} PUBLIC nlohmann_json::nlohmann_json fmt::fmt)
  target_compile_options(nplc_${name} PRIVATE ${NPLC_PROGRAM_OPTIONS})
  target_compile_definitions(nplc_${name} PRIVATE NPLC_VERSION="${PROJECT_VERSION}")
  nplc_use_common_headers(nplc_${name} ${NPLC_PROGRAM_HEADERS})
endfunction()

function(nplc_program name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_include_directories(${name} PRIVATE .)
  target_link_libraries(${name} PRIVATE ${ARG_DEPENDS} nplc_options nlohmann_json::nlohmann_json fmt::fmt)
  target_compile_options(${name} PRIVATE ${NPLC_PROGRAM_OPTIONS})
  target_compile_definitions(${name} PRIVATE NPLC_VERSION="${PROJECT_VERSION}")
  nplc_use_common_headers(${name} ${NPLC_PROGRAM_HEADERS})
  nplc_compile_together(${name})
  if(WIN32)
    target_sources(${name} PRIVATE "${PROJECT_SOURCE_DIR}/hal/windows/program.rc")
  endif()
endfunction()

function(nplc_program_documents name)
  cmake_parse_arguments(ARG "" "SECTION" "" ${ARGN})
  set(section 1)
  set(folder "${CMAKE_INSTALL_BINDIR}")
  if(ARG_SECTION)
    set(section ${ARG_SECTION})
    set(folder "${CMAKE_INSTALL_SBINDIR}")
  endif()
  set(generated "${CMAKE_CURRENT_BINARY_DIR}/generated")
  add_custom_command(OUTPUT "${generated}/${name}.${section}.gz" "${generated}/${name}" "${generated}/_${name}"
    COMMAND ${CMAKE_COMMAND} -E make_directory "${generated}"
    COMMAND ${name} man > "${generated}/${name}.${section}"
    COMMAND gzip --best --no-name --force --keep "${generated}/${name}.${section}"
    COMMAND ${name} completion bash > "${generated}/${name}"
    COMMAND ${name} completion zsh > "${generated}/_${name}"
    DEPENDS ${name} VERBATIM)
  add_custom_target(${name}_generated ALL DEPENDS "${generated}/${name}.${section}.gz")

  install(TARGETS ${name} RUNTIME DESTINATION "${folder}" COMPONENT ${name})
  install(FILES "${generated}/${name}.${section}.gz" DESTINATION "${CMAKE_INSTALL_MANDIR}/man${section}" COMPONENT ${name})
  install(FILES "${generated}/${name}" DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions"
          COMPONENT ${name})
  install(FILES "${generated}/_${name}" DESTINATION "${CMAKE_INSTALL_DATADIR}/zsh/site-functions" COMPONENT ${name})
endfunction()
