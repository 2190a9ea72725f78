#include "sequencer/explain.h"

namespace nplc::sequencer {

Verdict explain(TermView term, const State& state, InputImage image) {
    const Condition wanted = decode(term).condition;
    return {
        .other_step = wanted.step != state.step,
        .timer_running = wanted.needs_timer_zero && state.timer != 0,
        .counter_not_zero = wanted.needs_counter_zero && state.counter != 0,
        .differing = static_cast<InputImage>((wanted.input ^ image) & (wanted.care | kError)),
    };
}

}  // namespace nplc::sequencer
