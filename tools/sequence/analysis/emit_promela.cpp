#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "analysis/emit.h"
#include "emit_question.h"

namespace nplc::verify {
namespace {

using Kind = Condition::Kind;

constexpr std::array<const char*, 8> kBits = {"in0", "in1", "in2", "in3", "in4", "in5", "inpos", "error"};

std::string expression(const Condition& condition);

std::string joined(const Condition& condition, const char* sign) {
    std::string text;
    for (const Condition& operand : condition.operands)
        text += (text.empty() ? "(" : sign) + expression(operand);
    return text + ")";
}

std::string expression(const Condition& condition) {
    switch (condition.kind) {
        case Kind::constant:
            return condition.number != 0 ? "true" : "false";
        case Kind::image:
            return kBits[condition.number];
        case Kind::output:
            return fmt::format("out{}", condition.number);
        case Kind::timer_q:
            return "(!timer_runs)";
        case Kind::counter_q:
            return "(counter == 0)";
        case Kind::step:
            return fmt::format("(step == {})", condition.number);
        case Kind::negation:
            return "(!" + expression(condition.operands[0]) + ")";
        case Kind::all_of:
            return joined(condition, " && ");
        case Kind::any_of:
            return joined(condition, " || ");
        case Kind::odd_of:
            return joined(condition, " ^ ");
        case Kind::moving:
            return "(motion == 1 || motion == 2 || motion == 3 || motion >= 8)";
    }
    return {};
}

std::string formula_text(const Formula& formula, std::uint32_t hold_ms);

std::string joined_formula(const Formula& formula, const char* sign, std::uint32_t hold_ms) {
    std::string text;
    for (const Formula& part : formula.parts)
        text += (text.empty() ? "(" : sign) + formula_text(part, hold_ms);
    return text + ")";
}

std::string formula_text(const Formula& formula, std::uint32_t hold_ms) {
    using Of = Formula::Kind;
    switch (formula.kind) {
        case Of::ended:
            return expression(*formula.condition);
        case Of::began:
            return "began";
        case Of::first:
            return "kept_first";
        case Of::second:
            return "kept_second";
        case Of::negation:
            return "!" + formula_text(formula.parts[0], hold_ms);
        case Of::all_of:
            return joined_formula(formula, " && ", hold_ms);
        case Of::any_of:
            return joined_formula(formula, " || ", hold_ms);
        case Of::odd_of:
            return joined_formula(formula, " ^ ", hold_ms);
        case Of::held:
            return fmt::format("(held >= {})", hold_ms);
    }
    return {};
}

/// The condition at a scan's beginning that a formula needs; null if none.
const Condition* beginning_of(const Formula& formula) {
    if (formula.kind == Formula::Kind::began) return formula.condition;
    for (const Formula& part : formula.parts) {
        if (const Condition* found = beginning_of(part)) return found;
    }
    return nullptr;
}

std::string condition_of(const sequencer::Condition& condition) {
    std::vector<std::string> parts;
    if (condition.needs_timer_zero) parts.emplace_back("!timer_runs");
    if (condition.needs_counter_zero) parts.emplace_back("counter == 0");
    const unsigned compared = condition.care | unsigned{sequencer::kError};
    for (unsigned bit = 0; bit < 8; ++bit) {
        if (((compared >> bit) & 1U) == 0) continue;
        parts.push_back(fmt::format("{}{}", ((condition.input >> bit) & 1U) != 0 ? "" : "!", kBits[bit]));
    }
    return fmt::format("{}", fmt::join(parts, " && "));
}

/// motion after an order: those that change it, each with what it becomes.
std::string effect_text(const sequencer::MotorOrder& order) {
    constexpr unsigned kMotionCount{kMotions};
    const auto then = [&](unsigned before) {
        return static_cast<unsigned>(motion_after(static_cast<Motion>(before), order));
    };
    std::string text = "motion";
    bool is_one = true;
    for (unsigned before = 0; before < kMotionCount; ++before) {
        is_one = is_one && then(before) == then(0);
        if (then(before) != before)
            text = fmt::format("(motion == {} -> {} : {})", before, then(before), text);
    }
    return is_one ? fmt::format("{}", then(0)) : text;
}

std::string motion_text(const QuestionTerm& term, const Question& question) {
    if (!question.tells_motion || !term.order) return {};
    const unsigned cleared = term.cleared();
    if (cleared == 0 && table::effect_of(table::kind_of(*term.order)) == table::MotionEffect::none) return {};
    const std::string then = effect_text(*term.order);
    if (cleared == 0 || !question.clears_all()) {
        const bool begins = question.move_ms != 0 && is_timed(motion_after(Motion::none, *term.order));
        return fmt::format("motion = {}{}{}", then, question.clears_all() ? "; cleared = 0" : "",
                           begins ? "; moved = 0" : "");
    }
    return fmt::format(
        "before_clear = (cleared == 0 -> motion : before_clear); cleared = cleared | {}; "
        "motion = (cleared == {} -> before_clear : {})",
        cleared, kAllCleared, then);
}

std::string commands_of(const QuestionTerm& term, const Question& question) {
    const std::string motion = motion_text(term, question);
    if (term.term.is_flex) return motion;  // only a command to the motor
    const sequencer::FastStatement& fast = term.term.fast;
    std::string text =
        fmt::format("wrote = true; output_byte = {}",
                    fast.outputs + (fast.clears_counter ? 64 : 0) + (fast.counts_down ? 128 : 0));
    if (fast.next_step != sequencer::kNoSwitch) text += fmt::format("; next_step = {}", fast.next_step);
    if (fast.preset != 0)
        text += fmt::format("; {}_preset = {}", fast.presets_counter ? "counter" : "timer", fast.preset);
    if (!motion.empty()) text += "; " + motion;
    return text;
}

/// Spin limits the length of a d_step. Between two of them there is no choice, so a scan stays deterministic.
std::string terms_text(const Question& question) {
    constexpr unsigned kAtOnce = 16;
    struct Step {
        std::string text;
        unsigned terms = 0;
    };
    std::map<std::uint8_t, Step> steps;
    for (const QuestionTerm& term : question.terms) {
        const std::string commands = commands_of(term, question);
        if (commands.empty()) continue;
        Step& step = steps[term.term.condition.step];
        if (step.terms++ % kAtOnce == 0)
            step.text += step.text.empty() ? "d_step {\n" : "         };\n         d_step {\n";
        step.text +=
            fmt::format("         if :: {} -> {} :: else fi;\n", condition_of(term.term.condition), commands);
    }
    std::string text = "      if\n";
    for (const auto& [number, step] : steps)
        text += fmt::format("      :: step == {} -> {}         }}\n", number, step.text);
    return text + "      :: else\n      fi;\n";
}

constexpr const char* kPromelaHeader =
    R"(/* A NanoPLC sequence table (001 6.1) and its properties, as `seqc verify --assume any` asks them: inputs, INPOS and
   ERROR are free in each scan, and any time from 0 on passes between two scans, so that a running timer may or may
   not have ended. A condition is judged after each finished scan.

     spin -a F.pml && cc -O2 -DSAFETY -o pan pan.c && ./pan -m10000000 -N p_NAME

   "errors: 0" says that the claim p_NAME holds. Each claim says what no scan may be. For IS REACHABLE that is the
   condition itself: the property is proved if the claim fails. The next scan may come after any time, so WHENEVER
   is broken as soon as a scan leaves its deadline open. */
)";

constexpr const char* kVariables = R"(
bool scanned;                   /* a scan has just finished */
byte step;
bool out0, out1, out2, out3;
unsigned counter : 16;

hidden byte next_step;          /* the temporary command registers */
hidden byte wrote;
hidden byte output_byte;
hidden int timer_preset;
hidden int counter_preset;
)";

constexpr const char* kExecution = R"(
      /* the commands in the temporary command registers are executed */
      if
      :: wrote ->
         if :: next_step != 62 -> step = next_step :: else fi;
         out0 = output_byte & 1; out1 = (output_byte >> 1) & 1;
         out2 = (output_byte >> 2) & 1; out3 = (output_byte >> 3) & 1;
         if
         :: output_byte & 64 -> counter = 0
         :: !(output_byte & 64) && counter_preset > 0 -> counter = counter_preset
         :: !(output_byte & 64) && counter_preset == 0 && (output_byte & 128) && counter > 0 -> counter = counter - 1
         :: else
         fi;
         if :: timer_preset > 0 -> PRESETS :: else fi
      :: else
      fi;
)";

class Model {
  public:
    explicit Model(Question question) : question_(std::move(question)) {}

    Emission emission() {
        Emission emission;
        for (const Property& property : question_.properties) {
            if (asks_for_ways(property)) {
                emission.left_out.push_back(property.name);
            } else {
                add(property);
            }
        }
        const bool watches = watches_ != 0;
        emission.text = fmt::format(
            "{}{}{}\n{}\nactive proctype gateway() {{\n{}   do\n   :: atomic {{\n"
            "      d_step {{ {}scanned = false;{} }};\n{}{}{}"
            "      d_step {{ next_step = 62; wrote = false; timer_preset = 0; counter_preset = 0{} }};\n{}"
            "      d_step {{{}"
            "      next_step = 0; wrote = false; output_byte = 0; timer_preset = 0; counter_preset = 0;\n"
            "     {} scanned = true\n      }} }}\n   od\n}}\n{}",
            kPromelaHeader, assumed(), kVariables, declared(), watches ? choice_of_watch() : "", kept_,
            forgotten(question_.named), time(), chosen(), allowed(),
            question_.tells_motion && question_.clears_all() ? "; cleared = 0" : "", terms_text(question_),
            executed(), forgotten(question_.used & ~question_.named), claims_);
        return emission;
    }

  private:
    void add(const Property& property) {
        const Watch watch = watch_of(property);
        const bool is_watched = watch.remembers || watch.lasts != nullptr;
        std::string bad = formula_text(watch.bad, property.within_ms);
        if (is_watched) {
            ++watches_;
            bad = fmt::format("watch == {} && {}", watches_, bad);
            choices_ += fmt::format("   :: watch = {}; kept_first = {}; kept_second = {}\n", watches_,
                                    watch.first_at_power_up ? 1 : 0, watch.second_at_power_up ? 1 : 0);
        }
        if (watch.remembers) {
            kept_ += fmt::format(
                "if :: scanned && watch == {} -> next_first = {}; kept_second = {}; kept_first = next_first "
                ":: else fi;\n               ",
                watches_, formula_text(watch.first, 0), formula_text(watch.second, 0));
            if (const Condition* begins = beginning_of(watch.bad))
                began_ += fmt::format("; began = (watch == {} -> {} : began)", watches_, expression(*begins));
        }
        if (watch.lasts != nullptr) {
            kept_ += fmt::format(
                "if :: scanned && watch == {} -> held = ({} -> (held < 0 -> 0 : held) : -1) "
                ":: else fi;\n               ",
                watches_, expression(*watch.lasts));
        }
        claims_ += fmt::format("\n/* {} */\n#define bad_{} (scanned && {})\nltl p_{} {{ [] !bad_{} }}\n",
                               property.text, property.name, bad, property.name, property.name);
    }

    std::string assumed() const {
        std::string text;
        for (const Assumption& assumption : question_.assumptions)
            text += fmt::format("/* {} */\n", assumption.text);
        if (!question_.counts_time()) return text;
        return text + fmt::format(
                          "/* Time is counted in milliseconds, up to the {} after which more makes no "
                          "difference. */\n",
                          question_.longest());
    }

    std::string declared() const {
        std::string text;
        for (unsigned bit = 0; bit < 8; ++bit) {
            if (((question_.used >> bit) & 1U) != 0) text += fmt::format("bool {};\n", kBits[bit]);
        }
        text += question_.counts_time() ? "int timer, dt;\n#define timer_runs (timer > 0)\n"
                                        : "bool timer_runs;                /* the timer is not 0 */\n";
        if (question_.tells_motion) {
            text +=
                "byte motion;                    /* 0 INIT, 1 to a place, 2 runs, 3 to a place for an "
                "unknown time,\n"
                "                                   4 in its place, 5 there with V_SOLL 0, 6 on its way with "
                "V_SOLL 0,\n"
                "                                   7 in velocity mode with V_SOLL 0, 8 homing, 9 for an "
                "unknown time,\n"
                "                                   10 in a torque or test mode */\n";
        }
        if (question_.tells_motion && question_.clears_all()) text += "hidden byte cleared, before_clear;\n";
        if (question_.move_ms != 0)
            text += "int moved;                      /* for how long, to a place */\n";
        if (watches_ != 0) {
            text +=
                "byte watch;                     /* the property that remembers something of scans before "
                "*/\n"
                "bool kept_first, kept_second, began;\nhidden byte next_first;\n";
        }
        if (question_.longest_hold != 0)
            text += "int held = -1;                  /* for how long; -1 for not */\n";
        return text;
    }

    std::string choice_of_watch() const {
        return fmt::format("   if\n   :: watch = 0\n{}   fi;\n", choices_);
    }

    /// Resets the facts of a scan that are not read any more, so that equal states merge.
    std::string forgotten(unsigned bits) const {
        std::string text;
        for (unsigned bit = 0; bit < 8; ++bit) {
            if (((bits >> bit) & 1U) != 0) text += fmt::format(" {} = 0;", kBits[bit]);
        }
        return text;
    }

    std::string time() const {
        if (!question_.counts_time()) return "      if :: timer_runs -> timer_runs = false :: skip fi;\n";
        std::string text = fmt::format(
            "      do :: dt < {} -> dt++ :: break od; skip;\n"
            "      d_step {{ timer = (timer > dt -> timer - dt : 0);",
            question_.longest());
        if (question_.move_ms != 0) {
            text += fmt::format(
                " moved = ((motion == 1 || motion == 8) -> (moved + dt > {0} -> {1} : moved + dt) : 0);",
                question_.move_ms, question_.move_ms + 1);
        }
        if (question_.longest_hold != 0) {
            text += fmt::format(" held = (held < 0 -> held : (held + dt > {0} -> {0} : held + dt));",
                                question_.longest_hold);
        }
        return text + " dt = 0 };\n";
    }

    std::string chosen() const {
        std::string text;
        for (unsigned bit = 0; bit < 8; ++bit) {
            if (((question_.used >> bit) & 1U) != 0)
                text += fmt::format("      if :: {0} = 0 :: {0} = 1 fi;\n", kBits[bit]);
        }
        return text;
    }

    /// Scans that assumptions leave out, and the end of a move.
    std::string allowed() const {
        std::string text;
        for (const Assumption& assumption : question_.assumptions) {
            if (assumption.move_ms == 0) text += fmt::format("      !{};\n", expression(assumption.never));
        }
        if (question_.move_ms != 0) {
            text += fmt::format("      ((motion != 1 && motion != 8) || moved <= {} || inpos || error);\n",
                                question_.move_ms);
        }
        if (!began_.empty()) text += fmt::format("      d_step {{ {} }};\n", began_.substr(2));
        if (!question_.tells_motion) return text;
        text +=
            "      if\n      :: (motion == 1 || motion == 3 || motion == 8 || motion == 9) && inpos -> "
            "motion = 4\n";
        if (question_.move_ms != 0) {
            text +=
                "      :: motion == 1 && !inpos && error -> motion = 3\n"
                "      :: motion == 8 && !inpos && error -> motion = 9\n";
        }
        return text + "      :: else\n      fi;\n";
    }

    std::string executed() const {
        std::string text = kExecution;
        const std::string word = "PRESETS";
        text.replace(text.find(word), word.size(),
                     question_.counts_time() ? "timer = timer_preset" : "timer_runs = true");
        if (question_.move_ms != 0) text += "      moved = ((motion == 1 || motion == 8) -> moved : 0);\n";
        return text;
    }

    Question question_;
    unsigned watches_ = 0;
    std::string choices_;
    std::string kept_;
    std::string began_;
    std::string claims_;
};

}  // namespace

Emission promela_of(std::span<const std::uint8_t> table, const std::vector<Property>& properties,
                    const std::vector<Assumption>& assumptions) {
    return Model(Question(table, properties, assumptions, true)).emission();
}

}  // namespace nplc::verify
