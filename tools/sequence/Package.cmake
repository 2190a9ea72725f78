# The Debian package `seqc`: compiler, language server, debug adapter and simulator, with what editors need.
#   cmake --build --preset release --target seqc_debian_package
set(NPLC_SEQC_VSIX "" CACHE STRING "VS Code extension of the package seqc: a file, \"none\", or empty to build it with npm")

set(editors "${CMAKE_CURRENT_LIST_DIR}/editors")
set(vsix "${CMAKE_BINARY_DIR}/seqc_vscode/seqc.vsix")
file(GLOB_RECURSE extension_sources CONFIGURE_DEPENDS "${editors}/vscode/src/*" "${editors}/vscode/syntaxes/*" "${editors}/vscode/*.js*")
add_custom_command(OUTPUT "${vsix}"
  COMMAND "${editors}/vscode/build" "${vsix}" "${CMAKE_BINARY_DIR}/seqc_vscode"
  DEPENDS ${extension_sources} "${editors}/vscode/build"
  COMMENT "Building the VS Code extension" VERBATIM)
add_custom_target(seqc_vsix DEPENDS "${vsix}")

include(NplcPackage)
nplc_package_documents(seqc)
nplc_package_manual(seqc seqc)
nplc_package_manual(seqc nanoplc-sim)

# Deferred: the simulator's target is defined later.
cmake_language(DEFER DIRECTORY "${PROJECT_SOURCE_DIR}" CALL install TARGETS seqc nanoplc-sim RUNTIME DESTINATION bin COMPONENT seqc)
install(FILES "${editors}/nvim/lua/seqc.lua" DESTINATION share/seqc/nvim/lua COMPONENT seqc)
install(FILES LANGUAGE.md README.md RECIPES.md DESTINATION share/doc/seqc COMPONENT seqc)
install(FILES "${editors}/vscode/README.md" DESTINATION share/doc/seqc RENAME VSCODE.md COMPONENT seqc)
install(FILES "${editors}/nvim/README.md" DESTINATION share/doc/seqc RENAME NEOVIM.md COMPONENT seqc)
install(DIRECTORY examples DESTINATION share/doc/seqc COMPONENT seqc
        FILE_PERMISSIONS OWNER_READ OWNER_WRITE GROUP_READ WORLD_READ FILES_MATCHING PATTERN "*.seq" PATTERN "*.seqi" PATTERN "*.scn" PATTERN "README.md")
if(NPLC_SEQC_VSIX STREQUAL "")
  install(FILES "${vsix}" DESTINATION share/seqc COMPONENT seqc)
elseif(NOT NPLC_SEQC_VSIX STREQUAL "none")
  install(FILES "${NPLC_SEQC_VSIX}" DESTINATION share/seqc RENAME seqc.vsix COMPONENT seqc)
endif()

configure_file("${CMAKE_CURRENT_LIST_DIR}/package.cmake.in" "${CMAKE_BINARY_DIR}/CPackSeqc.cmake" @ONLY)
if(NPLC_SEQC_VSIX STREQUAL "")
  set(npm NPM "usr/share/seqc/seqc.vsix=${CMAKE_BINARY_DIR}/seqc_vscode" - "${CMAKE_BINARY_DIR}/seqc_vscode/meta.json")
endif()
nplc_debian_package(seqc_debian_package seqc CONFIG CPackSeqc.cmake FOLDER package_seqc PROGRAMS usr/bin/seqc usr/bin/nanoplc-sim
                    EMBEDDED "usr/bin/nanoplc-sim=${CMAKE_BINARY_DIR}/host-sim/fmu/nanoplc.so" ${npm})
add_dependencies(seqc_debian_package seqc_manual nanoplc-sim_manual)
if(NPLC_SEQC_VSIX STREQUAL "")
  add_dependencies(seqc_debian_package seqc_vsix)
endif()
