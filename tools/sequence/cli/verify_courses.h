#pragma once

#include <map>
#include <string>
#include <vector>

#include "analysis/verify.h"
#include "cli/input.h"

namespace nplc::seqc::cli {

enum class Played {
    to_the_end,  ///< nanoplc-sim run reaches the same end
    otherwise,   ///< it does not
    not_at_all,  ///< there is no nanoplc-sim next to seqc or on the path, or it failed
};

/// Result of playing a scenario.
struct Play {
    std::string file{};
    Played played = Played::not_at_all;
    std::string why{};      ///< reason for the last two
    bool by_motor = false;  ///< of `otherwise`: the virtual motor takes other times; else the gateway does
};
using Plays = std::map<std::string, Play>;  ///< by the result's name

std::string told(const Play& play);

struct CourseFiles {
    std::string stimulus{};
    std::string scenario{};
    std::string trace{};
    std::string plant{};              ///< a scenario with the motor's settings, or a plant file
    std::vector<std::string> read{};  ///< input files, which must not be overwritten
};

/// Findings of one check in a step and in its copies are reported as one, that of the step. Null: this
/// finding is part of another. Adds the names of the copies to `copies`.
const verify::Result* told_for(const verify::Report& report, const verify::Result& result,
                               const verify::Names& names, std::string& copies);

/// OUT.scn for the first, OUT-Name.scn for the others.
std::string file_for(const std::string& file, const std::string& name, bool is_first);

/// Writes the courses that break properties, then those of faults that the checks find: the first one to the
/// named files, others to OUT-Name. Scenarios are first played with nanoplc-sim, and marked if it does not
/// reach their end. Returns an error, or an empty text; `untouched` becomes a text about the files that
/// nothing was found for.
std::string written_courses(const verify::Report& report, const CourseFiles& wanted, const InputFile& program,
                            const verify::Names& names, Plays& plays, std::string& untouched);

}  // namespace nplc::seqc::cli
