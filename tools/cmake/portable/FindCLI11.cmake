include("${CMAKE_CURRENT_LIST_DIR}/PortableHeaders.cmake")
portable_header_target(CLI11::CLI11 CLI)
set(CLI11_FOUND TRUE)
