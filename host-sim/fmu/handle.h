#pragma once

#include <exception>
#include <string>
#include <utility>

#include "instance.h"

namespace nplc::sim::fmu {

/// What an importer holds. Those that live are known, so that one that was freed is noticed.
Instance* enlist(Instance* instance);
/// Null: it does not live, and nothing can be reported.
Instance* living(void* handle);
void discharge(void* handle);

enum class Outcome { done, refused, broken };

/// `work` with the instance, which answers false for what it refused. No exception leaves the library.
template <class Work>
Outcome guarded(void* handle, Work work) {
    Instance* instance = living(handle);
    if (instance == nullptr) return Outcome::refused;
    try {
        return work(*instance) ? Outcome::done : Outcome::refused;
    } catch (const std::exception& error) {
        instance->refuse(std::string("the simulation cannot go on: ") + error.what());
    } catch (...) {
    }
    return Outcome::broken;
}

/// Arrays of `count` values that are not there are refused.
inline bool are_there(const Instance& instance, std::size_t count, const void* references,
                      const void* values) {
    if (count == 0 || (references != nullptr && values != nullptr)) return true;
    return instance.refuse("an array of values is a null pointer");
}

}  // namespace nplc::sim::fmu
