#pragma once

#include <cstdint>
#include <unordered_set>
#include <vector>

#include "explorer.h"

/// From where a target can be reached in what was explored, and what leads to where it cannot.
namespace nplc::verify {

/// For each node, the minimum number of scans to the end of one of `target`; kFar if unreachable. Needs
/// all edges.
std::vector<std::uint32_t> distances_to(Explorer& explorer, const Target& target);

/// A scan after which a target cannot be reached.
struct Stuck {
    Explorer::Node node = Explorer::kNone;
    const Group* group = nullptr;
    ImageSet images;
    std::uint16_t counter = 0;  ///< after it
};
/// Scans by place and group, without their times.
using ScanKeys = std::unordered_set<std::uint64_t>;
inline std::uint64_t scan_key(const Place& place, std::uint32_t group) {
    return place.packed() << 30U | group;
}
ScanKeys scans_of(const Explorer& explorer);
/// The first scan outside of `target` that cannot lead to it, by the `distances`; only among `only`, if
/// given.
Stuck first_stuck(const Explorer& explorer, const Target& target, const std::vector<std::uint32_t>& distances,
                  const ScanKeys* only = nullptr);
/// The shortest course to it and with it.
std::vector<CourseScan> course_to(const Explorer& explorer, const Stuck& stuck);
/// The same scan in `explorer` as of another exploration, where it begins in `place`.
Stuck same_scan(const Explorer& explorer, const Place& place, const Stuck& stuck);

}  // namespace nplc::verify
