# portable_headers(FOLDER PATH_VARIABLE)
#
# Sets PATH_VARIABLE to a folder that shows /usr/include/FOLDER and nothing else of /usr/include, which a cross compiler
# must not see. For libraries of headers alone, the same on all systems.

function(portable_headers folder path_variable)
  if(NOT EXISTS "/usr/include/${folder}")
    message(FATAL_ERROR "/usr/include/${folder} is missing. Run tools/setup portable")
  endif()
  set(headers "${CMAKE_BINARY_DIR}/portable_headers")
  file(MAKE_DIRECTORY "${headers}")
  file(CREATE_LINK "/usr/include/${folder}" "${headers}/${folder}" SYMBOLIC)
  set(${path_variable} "${headers}" PARENT_SCOPE)
endfunction()

# The same as an imported target.
function(portable_header_target target folder)
  if(NOT TARGET ${target})
    portable_headers(${folder} headers)
    add_library(${target} INTERFACE IMPORTED GLOBAL)
    target_include_directories(${target} SYSTEM INTERFACE "${headers}")
  endif()
endfunction()
