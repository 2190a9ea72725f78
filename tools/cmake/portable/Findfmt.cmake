# Debian has fmt as a shared library for this machine only. The static one is made of its headers.
include("${CMAKE_CURRENT_LIST_DIR}/PortableHeaders.cmake")
if(NOT TARGET fmt::fmt)
  portable_headers(fmt headers)
  add_library(portable_fmt STATIC "${CMAKE_CURRENT_LIST_DIR}/fmt_library.cpp")
  target_include_directories(portable_fmt SYSTEM PUBLIC "${headers}")
  add_library(fmt::fmt ALIAS portable_fmt)
endif()
set(fmt_FOUND TRUE)
