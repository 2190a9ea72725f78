# nplc_commit_source(TARGET TEMPLATE [NAME=VALUE...])
#
# Adds the C++ file TEMPLATE, with the commit of the tree as @NPLC_COMMIT@ and the others as @NAME@, to TARGET. Looked at in each
# build; only a new commit compiles and links anew.
include_guard(GLOBAL)
set(NPLC_WRITE_COMMIT "${CMAKE_CURRENT_LIST_DIR}/write_commit.cmake")

function(nplc_commit_source target template)
  cmake_path(ABSOLUTE_PATH template)
  cmake_path(GET template STEM LAST_ONLY name)
  set(source "${CMAKE_CURRENT_BINARY_DIR}/${target}_${name}")
  list(TRANSFORM ARGN PREPEND -D)
  add_custom_target(${target}_commit
    COMMAND "${CMAKE_COMMAND}" "-DSOURCE=${PROJECT_SOURCE_DIR}" "-DTEMPLATE=${template}" "-DOUTPUT=${source}" ${ARGN}
            -P "${NPLC_WRITE_COMMIT}"
    BYPRODUCTS "${source}" VERBATIM)
  target_sources(${target} PRIVATE "${source}")
  add_dependencies(${target} ${target}_commit)
endfunction()
