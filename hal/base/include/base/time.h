#pragma once

#include <chrono>
#include <cstdint>

namespace nplc::base {

using Microseconds = std::chrono::duration<std::int64_t, std::micro>;
using Milliseconds = std::chrono::duration<std::int64_t, std::milli>;

/// A point on the gateway's own monotonic time line; only differences are meaningful.
struct Monotonic {
    using duration = Microseconds;
};
using Instant = std::chrono::time_point<Monotonic, Microseconds>;

/// As a deadline: no work until something arrives.
inline constexpr Instant kNever = Instant::max();

// Compares the counts directly. Chrono's <=> would pass arguments and result through memory, 20 bytes of a
// microcontroller's flash per comparison.
constexpr bool operator<(Instant a, Instant b) {
    return a.time_since_epoch().count() < b.time_since_epoch().count();
}
constexpr bool operator>(Instant a, Instant b) {
    return b < a;
}
constexpr bool operator<=(Instant a, Instant b) {
    return !(b < a);
}
constexpr bool operator>=(Instant a, Instant b) {
    return !(a < b);
}

}  // namespace nplc::base

/// Visible in all of the project's namespaces.
namespace nplc {

constexpr bool operator<(base::Microseconds a, base::Microseconds b) {
    return a.count() < b.count();
}
constexpr bool operator>(base::Microseconds a, base::Microseconds b) {
    return b < a;
}
constexpr bool operator<=(base::Microseconds a, base::Microseconds b) {
    return !(b < a);
}
constexpr bool operator>=(base::Microseconds a, base::Microseconds b) {
    return !(a < b);
}

}  // namespace nplc
