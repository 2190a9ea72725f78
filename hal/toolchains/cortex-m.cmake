# Bare-metal Arm Cortex-M with Debian's gcc-arm-none-eabi. NPLC_CPU chooses the core, NPLC_BOARD the firmware's board.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR arm)
set(NPLC_CPU "cortex-m3" CACHE STRING "Value for -mcpu")
set(NPLC_BOARD "lm3s6965evb" CACHE STRING "Folder of firmware/boards")

set(CMAKE_C_COMPILER arm-none-eabi-gcc)
set(CMAKE_CXX_COMPILER arm-none-eabi-g++)
set(CMAKE_SIZE arm-none-eabi-size)
# The variants that can read LTO objects.
set(CMAKE_AR arm-none-eabi-gcc-ar CACHE STRING "Archiver")
set(CMAKE_RANLIB arm-none-eabi-gcc-ranlib CACHE STRING "Indexer of archives")
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)

# A single unit, optimised at link time. With -flifetime-dse=1 a constructor may rely on cleared memory:
# members that begin with 0 cost no instruction (boards/bare_metal/run.cpp). Without the two passes the image
# is smaller.
set(CMAKE_CXX_FLAGS_INIT "-mcpu=${NPLC_CPU} -mthumb -ffunction-sections -fdata-sections -fno-exceptions -fno-rtti \
-fno-threadsafe-statics -fno-unwind-tables -fno-asynchronous-unwind-tables \
-flifetime-dse=1 -fno-caller-saves -fno-if-conversion -flto")
set(CMAKE_EXE_LINKER_FLAGS_INIT "--specs=nano.specs --specs=nosys.specs -Wl,--gc-sections -flto-partition=one")
