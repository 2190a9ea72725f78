# Linux on 64-bit Arm with Debian's g++-aarch64-linux-gnu.
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(NPLC_TRIPLET aarch64-linux-gnu)
set(NPLC_DEBIAN_NAME arm64)
set(NPLC_EMULATOR qemu-aarch64-static)
include("${CMAKE_CURRENT_LIST_DIR}/debian-linux.cmake")
