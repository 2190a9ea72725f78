#pragma once

#include <optional>
#include <vector>

#include "concretize.h"
#include "conflict.h"
#include "ways_back.h"

/// Courses of an exploration without times, for questions whose first course no times fit: each is the
/// shortest that is not excluded.
namespace nplc::verify {

struct Way {
    std::vector<CourseScan> scans;
    std::optional<Overdue> overdue{};
};

/// Up to a scan of a target.
std::optional<Way> way_to_target(const Explorer& explorer, const Target& target, Excluded& excluded);
/// Up to a scan from which the target cannot be reached any more.
std::optional<Way> way_to_stuck(const Explorer& explorer, const Stuck& stuck, Excluded& excluded);
/// That may miss the deadline of a WHENEVER or of a NEVER .. WHILE; with `cuts` also while a line that is
/// lost holds the next scan up.
std::optional<Way> late_way(const Explorer& explorer, const Property& property, bool cuts,
                            Excluded& excluded);

}  // namespace nplc::verify
