#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "seqc/seqc.h"

/// Checks scenarios of nanoplc-sim with the simulator's own parser.
namespace nplc::rehearsal {

struct ScenarioMistake {
    int line = 0;    ///< from 1
    int column = 0;  ///< from 1, in bytes; 0: the whole line
    std::string message;
};

/// `symbols`: of the scenario's program. Returns no errors on systems without the simulator.
std::vector<ScenarioMistake> mistakes_in_scenario(std::string_view text, const std::string& file,
                                                  const seqc::Symbols& symbols);

}  // namespace nplc::rehearsal
