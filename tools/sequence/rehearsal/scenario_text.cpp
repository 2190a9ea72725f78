#include "rehearsal/scenario_text.h"

#include "rehearsal/names.h"
#include "sim/scenario.h"

namespace nplc::rehearsal {

std::vector<ScenarioMistake> mistakes_in_scenario(std::string_view text, const std::string& file,
                                                  const seqc::Symbols& symbols) {
    const sim::Names names = names_of(symbols);
    std::vector<ScenarioMistake> mistakes;
    for (sim::Mistake& mistake : sim::parse_scenario(text, file, names).mistakes)
        mistakes.push_back({mistake.line, mistake.column, std::move(mistake.message)});
    return mistakes;
}

}  // namespace nplc::rehearsal
