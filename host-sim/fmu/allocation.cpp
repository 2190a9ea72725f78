#include <cstddef>
#include <cstdlib>
#include <new>
#include <utility>

#include "arena.h"

namespace __gnu_cxx {
void __freeres();  // of libstdc++, which says it for tools such as valgrind
}

namespace {

using nplc::sim::fmu::Arena;

/// libstdc++'s reserve for exceptions, 72 KB that it has in each library and does not give back.
[[gnu::destructor]] void give_back_the_reserve() {
    __gnu_cxx::__freeres();
}

thread_local Arena* t_arena = nullptr;

/// In front of whatever is allocated.
struct alignas(std::max_align_t) Owner {
    Arena* arena;  // null: malloc's
};

void* allocate(std::size_t bytes) {
    const std::size_t whole = bytes + sizeof(Owner);
    if (whole < bytes) throw std::bad_alloc();
    Arena* arena = t_arena;
    void* place = nullptr;
    if (arena != nullptr) {
        t_arena = nullptr;  // the arena's own chunks do not lie in it
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

// The shared library's own, which nothing outside of it sees. The other forms are made of these.
void* operator new(std::size_t bytes) {
    return allocate(bytes);
}

void operator delete(void* taken) noexcept {
    release(taken);
}

void operator delete(void* taken, std::size_t) noexcept {
    release(taken);
}
