include("${CMAKE_CURRENT_LIST_DIR}/PortableHeaders.cmake")
portable_header_target(Stb::Stb stb)
set(Stb_FOUND TRUE)
