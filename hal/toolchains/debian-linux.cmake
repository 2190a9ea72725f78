# Shared by the Linux toolchain files, built with Debian's cross compilers. The includer has set:
#   NPLC_TRIPLET         as in the compiler's name
#   NPLC_DEBIAN_NAME     Debian's name of the architecture
#   NPLC_EMULATOR        runs its programs here
# NPLC_SYSROOT: the libraries other than the compiler's own.
get_filename_component(project "${CMAKE_CURRENT_LIST_DIR}/../.." ABSOLUTE)
set(NPLC_SYSROOT "${project}/build/sysroot/${NPLC_DEBIAN_NAME}" CACHE PATH "What tools/sysroot fetched")
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES NPLC_SYSROOT)

set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_LIBRARY_ARCHITECTURE ${NPLC_TRIPLET})
set(CMAKE_C_COMPILER ${NPLC_TRIPLET}-gcc)
set(CMAKE_CXX_COMPILER ${NPLC_TRIPLET}-g++)
set(CMAKE_STRIP ${NPLC_TRIPLET}-strip)
set(CMAKE_CROSSCOMPILING_EMULATOR ${NPLC_EMULATOR})

set(CMAKE_FIND_ROOT_PATH /usr/${NPLC_TRIPLET} "${NPLC_SYSROOT}")
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
set(ENV{PKG_CONFIG_LIBDIR} "${NPLC_SYSROOT}/usr/lib/${NPLC_TRIPLET}/pkgconfig")
set(ENV{PKG_CONFIG_SYSROOT_DIR} "${NPLC_SYSROOT}")
