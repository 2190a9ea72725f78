# For find_package(Python3). What stands first in PATH may be a script that looks for the interpreter each time it is started, which takes a
# second: the interpreter itself is asked where it is.

find_program(NPLC_PYTHON python3)
if(NPLC_PYTHON AND NOT Python3_EXECUTABLE)
  execute_process(COMMAND "${NPLC_PYTHON}" -c "import sys; print(sys.executable)"
                  OUTPUT_VARIABLE Python3_EXECUTABLE OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
endif()
