#pragma once

#include <cstdint>

/// Code between reset and the board's code, and after a fault. A board's linker script defines the addresses
/// (link_...); its vector table begins with VectorsOfCore.
namespace nplc::hal_mcu::cortex_m {

/// The registers that an exception pushes on the stack.
struct Frame {
    std::uint32_t r0, r1, r2, r3, r12, lr, pc, xpsr;
};

using Handler = void (*)();

/// The first 16 words of a vector table.
struct VectorsOfCore {
    std::uint32_t* stack;
    Handler reset;
    Handler nmi;
    Handler hard_fault;
    Handler memory_fault;
    Handler bus_fault;
    Handler usage_fault;
    Handler reserved_to_10[4];
    Handler svcall;
    Handler debug;
    Handler reserved_13;
    Handler pendsv;
    Handler systick;
};

extern "C" {
/// Paints the stack, initializes memory, constructs static objects and calls the board's run_firmware().
[[noreturn]] void nplc_reset();
/// Unhandled exception: takes a fresh stack and calls the board's end_firmware() with the exception's number
/// and the address where it happened, 0 if the stack was not usable.
void nplc_fault();
}

/// The first entries of every board's table.
constexpr VectorsOfCore vectors_of_core(std::uint32_t* stack, Handler systick) {
    return {.stack = stack,
            .reset = nplc_reset,
            .nmi = nplc_fault,
            .hard_fault = nplc_fault,
            .memory_fault = nplc_fault,
            .bus_fault = nplc_fault,
            .usage_fault = nplc_fault,
            .reserved_to_10 = {nplc_fault, nplc_fault, nplc_fault, nplc_fault},
            .svcall = nplc_fault,
            .debug = nplc_fault,
            .reserved_13 = nplc_fault,
            .pendsv = nplc_fault,
            .systick = systick};
}

/// Pattern of a stack word that was never used.
inline constexpr std::uint32_t kPaint = 0xA5A5'A5A5U;

}  // namespace nplc::hal_mcu::cortex_m

// Provided by the board, in the global namespace.
void run_firmware();
[[noreturn]] void end_firmware(std::uint32_t exception, std::uint32_t code_address);
