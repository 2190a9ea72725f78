#include "rehearsal/scenario_text.h"

namespace nplc::rehearsal {

std::vector<ScenarioMistake> mistakes_in_scenario(std::string_view, const std::string&,
                                                  const seqc::Symbols&) {
    return {};
}

}  // namespace nplc::rehearsal
