#pragma once

#include <exception>
#include <string>
#include <utility>

#include "instance.h"

namespace nplc::sim::fmu {

/// The handle for an importer. Existing instances are registered, so that the use of a freed one is detected.
Instance* enlist(Instance* instance);
/// Null if it does not exist; nothing can be reported then.
Instance* living(void* handle);
void discharge(void* handle);

enum class Outcome { done, refused, broken };

/// Calls `work` with the instance; `work` returns false for an error. No exception leaves the library.
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

/// Null pointers to arrays of `count` values are refused.
inline bool are_there(const Instance& instance, std::size_t count, const void* references,
                      const void* values) {
    if (count == 0 || (references != nullptr && values != nullptr)) return true;
    return instance.refuse("an array of values is a null pointer");
}

}  // namespace nplc::sim::fmu
