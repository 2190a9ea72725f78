#pragma once

#include <map>
#include <string>
#include <vector>

#include "cli/input.h"
#include "verify/verify.h"

namespace nplc::seqc::cli {

enum class Played {
    to_the_end,  ///< nanoplc-sim run comes to the same end
    otherwise,   ///< it does not: the virtual motor cannot follow
    not_at_all,  ///< there is no nanoplc-sim beside seqc or on the path, or it refused
};

/// What became of a scenario.
struct Play {
    std::string file{};
    Played played = Played::not_at_all;
    std::string why{};  ///< otherwise and not at all
};
using Plays = std::map<std::string, Play>;  ///< by the property's name

std::string told(const Play& play);

struct CourseFiles {
    std::string stimulus{};
    std::string scenario{};
    std::string trace{};
    std::string plant{};              ///< a scenario with what the motor is like, or a plant file
    std::vector<std::string> read{};  ///< what is never written over
};

/// OUT.scn for the first, OUT-Name.scn for the others.
std::string file_for(const std::string& file, const std::string& name, bool is_first);

/// Writes the courses that break properties, the first in the files named, others in OUT-Name. Scenarios are
/// played with nanoplc-sim first, and marked if it does not come to their end. Returns what went wrong, or
/// nothing.
std::string written_courses(const verify::Report& report, const CourseFiles& wanted, const InputFile& program,
                            const verify::Names& names, Plays& plays);

}  // namespace nplc::seqc::cli
