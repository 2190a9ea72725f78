#include <cstdint>

// Named in cortex-m.ld; only their addresses mean anything.
extern "C" {
extern std::uint32_t link_stack_top;
extern const std::uint32_t link_data_load;
extern std::uint32_t link_data_begin;
extern std::uint32_t link_data_end;
extern std::uint32_t link_bss_begin;
extern std::uint32_t link_bss_end;
extern void (*link_init_begin)();
extern void (*link_init_end)();
}

void run_firmware();  // in main.cpp: standard C++ forbids calling main itself

namespace {

[[noreturn]] void halt() {
    for (;;) {
    }
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

[[noreturn]] void reset_handler() {
    prepare_memory();
    run_constructors();
    run_firmware();
    halt();
}

// The C++ library's own versions drag in the heap. Firmware never ends, so no destructor is kept.
[[noreturn]] void __cxa_pure_virtual() {
    halt();
}
int __aeabi_atexit(void*, void (*)(void*), void*) {
    return 0;
}
void* __dso_handle = nullptr;

struct Vectors {
    std::uint32_t* stack;
    void (*reset)();
    void (*faults[14])();
};

[[gnu::section(".vectors"), gnu::used]] extern const Vectors vectors{
    &link_stack_top,
    reset_handler,
    {halt, halt, halt, halt, halt, halt, halt, halt, halt, halt, halt, halt, halt, halt}};
}
