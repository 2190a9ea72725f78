# nplc_program_documents(NAME)
#
# Installs program NAME with the manual page and the completions that it prints of itself (tools/command_line).
include(GNUInstallDirs)

function(nplc_program_documents name)
  set(generated "${CMAKE_CURRENT_BINARY_DIR}/generated")
  add_custom_command(OUTPUT "${generated}/${name}.1" "${generated}/${name}" "${generated}/_${name}"
    COMMAND ${CMAKE_COMMAND} -E make_directory "${generated}"
    COMMAND ${name} man > "${generated}/${name}.1"
    COMMAND ${name} completion bash > "${generated}/${name}"
    COMMAND ${name} completion zsh > "${generated}/_${name}"
    DEPENDS ${name} VERBATIM)
  add_custom_target(${name}_generated ALL DEPENDS "${generated}/${name}.1")

  install(TARGETS ${name} RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
  install(FILES "${generated}/${name}.1" DESTINATION "${CMAKE_INSTALL_MANDIR}/man1")
  install(FILES "${generated}/${name}" DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions")
  install(FILES "${generated}/_${name}" DESTINATION "${CMAKE_INSTALL_DATADIR}/zsh/site-functions")
endfunction()
