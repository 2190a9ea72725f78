# Included by scripts, sets
#   NPLC_COMMIT        which commit the tree SOURCE is of, 12 digits, with "-changed" behind it if it is not as committed; "unknown"
#   NPLC_COMMIT_TIME   seconds since 1970, empty if unknown
#
# In a tree without git (git archive fills in archived_commit.txt) it is what is written there.
cmake_minimum_required(VERSION 3.25)
file(READ "${CMAKE_CURRENT_LIST_DIR}/archived_commit.txt" archived)
set(NPLC_COMMIT unknown)
set(NPLC_COMMIT_TIME "")
if(archived MATCHES "^([0-9a-f]+) ([0-9]+)")
  string(SUBSTRING "${CMAKE_MATCH_1}" 0 12 NPLC_COMMIT)
  set(NPLC_COMMIT_TIME "${CMAKE_MATCH_2}")
else()
  execute_process(COMMAND git -C "${SOURCE}" describe --always --dirty=-changed --abbrev=40 --exclude=*
    OUTPUT_VARIABLE described OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE code)
  if(code EQUAL 0)
    string(REGEX REPLACE "^([0-9a-f]+)" "" changed "${described}")
    string(SUBSTRING "${described}" 0 12 NPLC_COMMIT)
    string(APPEND NPLC_COMMIT "${changed}")
    execute_process(COMMAND git -C "${SOURCE}" log -1 --format=%ct
      OUTPUT_VARIABLE NPLC_COMMIT_TIME OUTPUT_STRIP_TRAILING_WHITESPACE)
  endif()
endif()
