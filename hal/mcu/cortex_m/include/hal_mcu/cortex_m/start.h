#pragma once

#include <cstdint>

/// What happens between reset and the board's code, and after a fault. The linker script of a board names
/// the places (link_...), its vector table begins with VectorsOfCore.
namespace nplc::hal_mcu::cortex_m {

/// The registers that an exception leaves on the stack.
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
/// Paints the stack, sets up memory, constructs what is static and calls the board's run_firmware().
[[noreturn]] void nplc_reset();
/// Every exception that is nobody's: takes a fresh stack and calls the board's end_firmware() with the
/// exception's number and the place where it happened, 0 if the stack was not usable.
void nplc_fault();
}

/// What every board begins its table with.
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

/// A word of stack that nothing has used since the start.
inline constexpr std::uint32_t kPaint = 0xA5A5'A5A5U;

}  // namespace nplc::hal_mcu::cortex_m

// The board's; they have no module.
void run_firmware();
[[noreturn]] void end_firmware(std::uint32_t exception, std::uint32_t code_address);
