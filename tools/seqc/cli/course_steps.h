#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "verify/course.h"
#include "verify/property.h"

namespace nplc::seqc::cli {

/// A step transition.
struct StepChange {
    std::string time;  ///< in milliseconds, as printed
    std::string from;
    std::string to;
    bool gets_in_pos = false;  ///< INPOS became 1 in that step; for courses only
};
using CourseSteps = std::vector<StepChange>;

CourseSteps steps_of(const verify::Course& course, const verify::Names& names);
/// Parses the output of nanoplc-sim run.
CourseSteps steps_in_timeline(std::string_view printed);

/// Describes where a rehearsal deviates from its course.
std::string where_it_leaves(const CourseSteps& course, const CourseSteps& rehearsal);

}  // namespace nplc::seqc::cli
