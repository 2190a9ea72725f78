#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/course.h"
#include "analysis/property.h"

namespace nplc::seqc::cli {

/// A step transition.
struct StepChange {
    std::string time;  ///< in milliseconds, as printed
    std::string from;
    std::string to;
    bool gets_in_pos = false;    ///< INPOS became 1 in that step; for courses only
    bool has_in_pos = false;     ///< INPOS was 1 when it was left; of a rehearsal: it led out
    std::uint16_t limit_ms = 0;  ///< of a move to a place that began with the step, for courses only; 0: none
};
using CourseSteps = std::vector<StepChange>;

CourseSteps steps_of(const verify::Course& course, const verify::Names& names);
/// Parses the output of nanoplc-sim run.
CourseSteps steps_in_timeline(std::string_view printed);

struct Deviation {
    std::string where;
    bool by_motor = false;  ///< INPOS comes otherwise than in the course
    bool is_plant = false;  ///< and no time limit is too short for it
};
Deviation where_it_leaves(const CourseSteps& course, const CourseSteps& rehearsal);

}  // namespace nplc::seqc::cli
