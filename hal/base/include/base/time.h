#pragma once

#include <chrono>
#include <cstdint>

namespace nplc::base {

using Microseconds = std::chrono::duration<std::int64_t, std::micro>;
using Milliseconds = std::chrono::duration<std::int64_t, std::milli>;

/// A point on the gateway's own monotonic time line; only differences mean anything.
struct Monotonic {
    using duration = Microseconds;
};
using Instant = std::chrono::time_point<Monotonic, Microseconds>;

/// As a deadline: nothing is to be done until something arrives.
inline constexpr Instant kNever = Instant::max();

}  // namespace nplc::base
