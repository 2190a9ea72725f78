#pragma once

#include "condition_parser.h"
#include "sim/scenario.h"
#include "tokens.h"

namespace nplc::sim {

/// What a scenario can do. All functions throw LineMistake.
class ActionParser {
  public:
    ActionParser(Reader& reader, ConditionParser& conditions) : reader_(reader), conditions_(conditions) {}

    /// [after TIME] ACTION {, [after TIME] ACTION}; times add up.
    Actions actions();

  private:
    void action(Actions& list, Time after);
    void set_input(Actions& list, Time after);
    void check_known_word();
    void pulse(Actions& list, Time after);
    void line(Actions& list, Time after);
    void line_direction(action::SpoilLine& spoil);
    bool fault(action::SpoilLine& spoil);
    void motor(Actions& list, Time after);
    void gateway(Actions& list, Time after);
    void seed(Actions& list, Time after);
    void log(Actions& list, Time after);

    Reader& reader_;
    ConditionParser& conditions_;
};

}  // namespace nplc::sim
