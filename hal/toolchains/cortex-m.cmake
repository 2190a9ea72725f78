# Bare-metal Arm Cortex-M with Debian's gcc-arm-none-eabi. NPLC_CPU chooses the core.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR arm)
set(NPLC_CPU "cortex-m3" CACHE STRING "Value for -mcpu")

set(CMAKE_C_COMPILER arm-none-eabi-gcc)
set(CMAKE_CXX_COMPILER arm-none-eabi-g++)
set(CMAKE_SIZE arm-none-eabi-size)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
# A compiler cache does not know the call graphs that the compiler writes for the stack's bound, and would lose them.
set(CMAKE_CXX_COMPILER_LAUNCHER "" CACHE STRING "None: see hal/toolchains/cortex-m.cmake")

set(CMAKE_CXX_FLAGS_INIT "-mcpu=${NPLC_CPU} -mthumb -ffunction-sections -fdata-sections -fno-exceptions -fno-rtti \
-fno-threadsafe-statics -fno-unwind-tables -fno-asynchronous-unwind-tables -fcallgraph-info=su")
set(CMAKE_EXE_LINKER_FLAGS_INIT "--specs=nano.specs --specs=nosys.specs -Wl,--gc-sections")
