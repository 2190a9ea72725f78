#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "verify/course.h"
#include "verify/property.h"

namespace nplc::seqc::cli {

/// A step that was left for another.
struct StepChange {
    std::string time;  ///< in milliseconds, as it was printed
    std::string from;
    std::string to;
    bool gets_in_pos = false;  ///< INPOS came in that step; of a course only
};
using CourseSteps = std::vector<StepChange>;

CourseSteps steps_of(const verify::Course& course, const verify::Names& names);
/// From what nanoplc-sim run prints.
CourseSteps steps_in_timeline(std::string_view printed);

/// Where a rehearsal leaves its course, in words.
std::string where_it_leaves(const CourseSteps& course, const CourseSteps& rehearsal);

}  // namespace nplc::seqc::cli
