# cmake -DSOURCE=... -DTEMPLATE=... -DOUTPUT=... [-DNAME=VALUE...] -P write_commit.cmake
#
# Writes OUTPUT of TEMPLATE, with the commit of the tree SOURCE as @NPLC_COMMIT@, if it says another one than before.
include("${CMAKE_CURRENT_LIST_DIR}/commit.cmake")
configure_file("${TEMPLATE}" "${OUTPUT}" @ONLY)
