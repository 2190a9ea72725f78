# cmake -DSOURCE=... -P print_commit.cmake: prints the commit of the tree SOURCE and its time, as commit.cmake finds them.
include("${CMAKE_CURRENT_LIST_DIR}/commit.cmake")
execute_process(COMMAND "${CMAKE_COMMAND}" -E echo "${NPLC_COMMIT} ${NPLC_COMMIT_TIME}")
