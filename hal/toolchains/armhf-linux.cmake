# Linux on 32-bit Arm (ARMv7 with hardware floating point) with Debian's g++-arm-linux-gnueabihf. A Raspberry Pi of the
# first generation and a Zero without a number are ARMv6: its programs do not run there.
set(CMAKE_SYSTEM_PROCESSOR armv7l)
set(NPLC_TRIPLET arm-linux-gnueabihf)
set(NPLC_DEBIAN_NAME armhf)
set(NPLC_EMULATOR qemu-arm-static)
include("${CMAKE_CURRENT_LIST_DIR}/debian-linux.cmake")
