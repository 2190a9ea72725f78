#include <cstddef>
#include <cstdlib>
#include <new>
#include <utility>

#include "arena.h"

namespace __gnu_cxx {
void __freeres();  // libstdc++'s function that frees its reserve, provided for tools such as valgrind
}

namespace {

using nplc::sim::fmu::Arena;

/// Frees libstdc++'s reserve for exceptions, 72 KB per library, which it does not free itself.
[[gnu::destructor]] void give_back_the_reserve() {
    __gnu_cxx::__freeres();
}

thread_local Arena* t_arena = nullptr;

/// Header in front of each allocation.
struct alignas(std::max_align_t) Owner {
    Arena* arena;  // null: allocated by malloc
};

void* allocate(std::size_t bytes) {
    const std::size_t whole = bytes + sizeof(Owner);
    if (whole < bytes) throw std::bad_alloc();
    Arena* arena = t_arena;
    void* place = nullptr;
    if (arena != nullptr) {
        t_arena = nullptr;  // the arena's own chunks are not allocated in it
        try {
            place = arena->take(whole);
        } catch (...) {
            t_arena = arena;
            throw;
        }
        t_arena = arena;
    } else {
        place = std::malloc(whole);
        if (place == nullptr) throw std::bad_alloc();
    }
    return new (place) Owner{arena} + 1;
}

void release(void* taken) noexcept {
    if (taken == nullptr) return;
    Owner* owner = static_cast<Owner*>(taken) - 1;
    if (owner->arena != nullptr)
        owner->arena->give_back(owner);
    else
        std::free(owner);
}

}  // namespace

namespace nplc::sim::fmu {

AllocateIn::AllocateIn(Arena& arena) : before_(std::exchange(t_arena, &arena)) {}

AllocateIn::~AllocateIn() {
    t_arena = before_;
}

}  // namespace nplc::sim::fmu

// Operators of the shared library only, not exported. The other forms use these.
void* operator new(std::size_t bytes) {
    return allocate(bytes);
}

void operator delete(void* taken) noexcept {
    release(taken);
}

void operator delete(void* taken, std::size_t) noexcept {
    release(taken);
}
