// Calls of the debugger's host (Arm, "Semihosting for AArch32 and AArch64"), and what the C library asks of a
// system.

#include "semihosting.h"

#include <cstddef>
#include <cstdint>

extern "C" {
extern char link_heap_begin;
extern char link_heap_end;
}

namespace nplc::mcu_units {
namespace {

constexpr std::uint32_t kWrite0 = 0x04;
constexpr std::uint32_t kExit = 0x18;
constexpr std::uint32_t kApplicationExit = 0x20026;
constexpr std::uint32_t kRunTimeError = 0x20023;

void call(std::uint32_t operation, std::uint32_t parameter) {
    register std::uint32_t r0 asm("r0") = operation;
    register std::uint32_t r1 asm("r1") = parameter;
    asm volatile("bkpt 0xAB" : "+r"(r0) : "r"(r1) : "memory");
}

}  // namespace

void print(const char* text) {
    call(kWrite0, reinterpret_cast<std::uint32_t>(text));
}

void exit(bool well) {
    call(kExit, well ? kApplicationExit : kRunTimeError);
    for (;;) {
    }
}

}  // namespace nplc::mcu_units

extern "C" {

void* _sbrk(std::ptrdiff_t bytes) {
    static char* at = &link_heap_begin;
    if (&link_heap_end - at < bytes) {
        nplc::mcu_units::print("out of memory\n");
        nplc::mcu_units::exit(false);
    }
    char* const given = at;
    at += bytes;
    return given;
}

/// After abort(), which is what an exception comes to here.
void _exit(int) {
    nplc::mcu_units::print("the library aborted\n");
    nplc::mcu_units::exit(false);
}

}  // extern "C"
