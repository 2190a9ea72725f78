#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "seqc/seqc.h"

/// Scenarios of nanoplc-sim, read by the simulator's own reader.
namespace nplc::rehearsal {

struct ScenarioMistake {
    int line = 0;    ///< from 1
    int column = 0;  ///< from 1, in bytes; 0: the whole line
    std::string message;
};

/// `symbols`: of the program that it is for. None where this system has no simulator.
std::vector<ScenarioMistake> mistakes_in_scenario(std::string_view text, const std::string& file,
                                                  const seqc::Symbols& symbols);

}  // namespace nplc::rehearsal
