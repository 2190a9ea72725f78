# nplc_package_documents(PACKAGE)
#
# Installs copyright, notices and changelog of the Debian package, in the component of its name.
#
# nplc_package_manual(PACKAGE PROGRAM)
#
# Installs a manual page of what the program says with --help, and the completions that it prints; target PROGRAM_manual
# makes them.
#
# nplc_debian_package(TARGET PACKAGE CONFIG FILE FOLDER DIR PROGRAMS usr/bin/P... [EMBEDDED usr/bin/P=LIBRARY]
#                     [NPM INSIDE=FOLDER NOTICE INPUTS])
#
# Target TARGET makes the package by the CPack configuration FILE in DIR of the build folder, with its bill of materials
# (tools/packing). PROGRAMS are paths in the package, each a target's; EMBEDDED names a library that is
# contained in one, with its map beside it, and NPM the packages bundled into the file INSIDE.
include_guard(GLOBAL)
set(NPLC_PACKAGE_CONTACT "NanoPLC Gateway <nanoplc@nanoplc.invalid>" CACHE STRING "Maintainer of the Debian packages")

function(nplc_package_documents package)
  set(documents "${CMAKE_BINARY_DIR}/documents/${package}/")
  install(DIRECTORY "${documents}" DESTINATION share/doc/${package} COMPONENT ${package}
          FILE_PERMISSIONS OWNER_READ OWNER_WRITE GROUP_READ WORLD_READ)
endfunction()

function(nplc_package_manual package program)
  include(NplcPython)
  find_package(Python3 COMPONENTS Interpreter)
  if(NOT Python3_FOUND)
    add_custom_target(${program}_manual)
    return()
  endif()
  set(page "${CMAKE_CURRENT_BINARY_DIR}/generated/${program}.1.gz")
  file(MAKE_DIRECTORY "${CMAKE_CURRENT_BINARY_DIR}/generated")
  set(bash "${CMAKE_CURRENT_BINARY_DIR}/generated/${program}")
  set(zsh "${CMAKE_CURRENT_BINARY_DIR}/generated/_${program}")
  add_custom_command(OUTPUT "${page}" "${bash}" "${zsh}"
    COMMAND ${program} completion bash > "${bash}"
    COMMAND ${program} completion zsh > "${zsh}"
    COMMAND Python3::Interpreter -B "${PROJECT_SOURCE_DIR}/tools/packing/man_of_help" "$<TARGET_FILE:${program}>" "${page}"
    DEPENDS ${program} "${PROJECT_SOURCE_DIR}/tools/packing/man_of_help" VERBATIM)
  add_custom_target(${program}_manual DEPENDS "${page}")
  install(FILES "${page}" DESTINATION share/man/man1 COMPONENT ${package})
  install(FILES "${bash}" DESTINATION share/bash-completion/completions COMPONENT ${package})
  install(FILES "${zsh}" DESTINATION share/zsh/site-functions COMPONENT ${package})
endfunction()

function(nplc_debian_package target package)
  cmake_parse_arguments(ARG "" "CONFIG;FOLDER" "PROGRAMS;EMBEDDED;NPM" ${ARGN})
  set(told "")
  foreach(inside IN LISTS ARG_PROGRAMS)
    cmake_path(GET inside FILENAME program)
    # Its target may come later.
    cmake_language(EVAL CODE "cmake_language(DEFER DIRECTORY [[${PROJECT_SOURCE_DIR}]]
      CALL target_link_options ${program} PRIVATE [[-Wl,-Map=$<TARGET_FILE:${program}>.map]] [[-Wl,-z,now]])")
    list(APPEND told --program "${inside}=$<TARGET_FILE:${program}>")
    list(APPEND programs ${program})
  endforeach()
  foreach(embedded IN LISTS ARG_EMBEDDED)
    list(APPEND told --embedded "${embedded}")
  endforeach()
  if(ARG_NPM)
    list(APPEND told --npm ${ARG_NPM})
  endif()
  include(NplcPython)
  find_package(Python3 COMPONENTS Interpreter)
  if(NOT Python3_FOUND)
    add_custom_target(${target} COMMAND ${CMAKE_COMMAND} -E echo "Packages need python3: tools/setup package" COMMAND false VERBATIM)
    return()
  endif()
  add_custom_target(${target}
    COMMAND Python3::Interpreter -B "${PROJECT_SOURCE_DIR}/tools/packing/pack_debian" ${package}
            --source "${PROJECT_SOURCE_DIR}" --build "${CMAKE_BINARY_DIR}" --cpack "${CMAKE_CPACK_COMMAND}"
            --config "${CMAKE_BINARY_DIR}/${ARG_CONFIG}" --out "${CMAKE_BINARY_DIR}/${ARG_FOLDER}"
            --documents "${CMAKE_BINARY_DIR}/documents/${package}" --contact "${NPLC_PACKAGE_CONTACT}" ${told}
    VERBATIM)
  add_dependencies(${target} ${programs})
endfunction()
