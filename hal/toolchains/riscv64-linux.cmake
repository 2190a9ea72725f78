# Linux on 64-bit RISC-V with Debian's g++-riscv64-linux-gnu.
set(CMAKE_SYSTEM_PROCESSOR riscv64)
set(NPLC_TRIPLET riscv64-linux-gnu)
set(NPLC_DEBIAN_NAME riscv64)
set(NPLC_EMULATOR qemu-riscv64-static)
include("${CMAKE_CURRENT_LIST_DIR}/debian-linux.cmake")
