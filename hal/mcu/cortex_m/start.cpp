#include "hal_mcu/cortex_m/start.h"

#include "hal_mcu/cortex_m/core.h"

// Defined in a board's linker script; only their addresses are used.
extern "C" {
extern std::uint32_t link_stack_begin;
extern std::uint32_t link_stack_top;
extern const std::uint32_t link_data_load;
extern std::uint32_t link_data_begin;
extern std::uint32_t link_data_end;
extern std::uint32_t link_bss_begin;
extern std::uint32_t link_bss_end;
extern void (*link_init_begin)();
extern void (*link_init_end)();
}

namespace nplc::hal_mcu::cortex_m {
namespace {

/// SVCall's number, which is otherwise unused: marks a call of a pure virtual function and a return of
/// run_firmware.
constexpr std::uint32_t kPureCall = 11;
constexpr std::uint32_t kPaintedBelow = 64;  ///< bytes below the top that reset itself uses

/// Volatile: excludes memset, whose own frame would be in the painted area.
void paint_stack() {
    const auto top = reinterpret_cast<std::uint32_t>(&link_stack_top) - kPaintedBelow;
    for (volatile std::uint32_t* word = &link_stack_begin; reinterpret_cast<std::uint32_t>(word) < top;
         ++word)
        *word = kPaint;
}

void prepare_memory() {
    const std::uint32_t* from = &link_data_load;
    for (std::uint32_t* to = &link_data_begin; to != &link_data_end; ++to) *to = *from++;
    for (std::uint32_t* to = &link_bss_begin; to != &link_bss_end; ++to) *to = 0;
}

void run_constructors() {
    for (auto* constructor = &link_init_begin; constructor != &link_init_end; ++constructor) (*constructor)();
}

}  // namespace

extern "C" {

void nplc_reset() {
    paint_stack();
    prepare_memory();
    run_constructors();
    run_firmware();
    end_firmware(kPureCall, 0);
}

[[noreturn, gnu::used]] void nplc_fault_on_fresh_stack(const Frame* frame, std::uint32_t exception) {
    const auto address = reinterpret_cast<std::uint32_t>(frame);
    const bool usable = address >= reinterpret_cast<std::uint32_t>(&link_stack_begin) &&
                        address + sizeof(Frame) <= reinterpret_cast<std::uint32_t>(&link_stack_top);
    const std::uint32_t pc = usable ? frame->pc : 0;
    end_firmware(exception, pc);
}

/// The old stack may be the cause of the fault, and its contents are no longer needed.
[[gnu::naked]] void nplc_fault() {
    asm volatile(
        "cpsid i\n\t"
        "mov r0, sp\n\t"
        "mrs r1, ipsr\n\t"
        "ldr r2, =link_stack_top - 256\n\t"
        "cmp r0, r2\n\t"
        "bhs 1f\n\t"
        "ldr r2, =link_stack_top\n\t"
        "1: mov sp, r2\n\t"
        "bl nplc_fault_on_fresh_stack\n\t"
        ".ltorg");
}

// The C++ library's versions need the heap. The firmware never ends, so no destructor is registered.
[[noreturn]] void __cxa_pure_virtual() {
    end_firmware(kPureCall, reinterpret_cast<std::uint32_t>(__builtin_return_address(0)));
}
int __aeabi_atexit(void*, void (*)(void*), void*) {
    return 0;
}
void* __dso_handle = nullptr;

}  // extern "C"

}  // namespace nplc::hal_mcu::cortex_m
