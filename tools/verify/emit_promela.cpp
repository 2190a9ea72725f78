#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <map>

#include "manual_term.h"
#include "verify/emit.h"

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
        case Kind::moving:  // no matter of the table alone
            break;
    }
    return {};
}

/// What no scan may be for the claim to hold; empty for what linear time cannot say.
std::string bad_scan(const Property& property) {
    switch (property.form) {
        case Form::never:
        case Form::reachable:
            return expression(property.condition);
        case Form::always:
            return "(!" + expression(property.condition) + ")";
        case Form::whenever:
            return fmt::format("({} && !{})", expression(property.condition), expression(property.then));
        default:
            return {};
    }
}

std::string condition_of(const ManualTerm& term) {
    std::vector<std::string> parts;
    if (term.timer_must_be_zero) parts.emplace_back("!timer_runs");
    if (term.counter_must_be_zero) parts.emplace_back("counter == 0");
    for (unsigned bit = 0; bit < 8; ++bit) {
        if (((term.compared >> bit) & 1U) == 0) continue;
        parts.push_back(fmt::format("{}{}", ((term.input >> bit) & 1U) != 0 ? "" : "!", kBits[bit]));
    }
    return fmt::format("{}", fmt::join(parts, " && "));
}

std::string commands_of(const ManualTerm& term) {
    std::string text = fmt::format("wrote = true; output_byte = {}", term.output_byte);
    if (term.names_next) text += fmt::format("; next_step = {}", term.next_state);
    if (term.word != 0)
        text += fmt::format("; {}_preset = {}", term.word_is_counter ? "counter" : "timer", term.word);
    return text;
}

/// Spin takes no d_step of any length. Between two of them nothing is chosen, so a scan stays one course.
std::string terms_text(const std::vector<ManualTerm>& terms) {
    constexpr unsigned kAtOnce = 16;
    struct Step {
        std::string text;
        unsigned terms = 0;
    };
    std::map<std::uint8_t, Step> steps;
    for (const ManualTerm& term : terms) {
        if (term.is_flexmac) continue;  // an order to the motor and nothing else
        Step& step = steps[term.state];
        if (step.terms++ % kAtOnce == 0)
            step.text += step.text.empty() ? "d_step {\n" : "         };\n         d_step {\n";
        step.text +=
            fmt::format("         if :: {} -> {} :: else fi;\n", condition_of(term), commands_of(term));
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
bool timer_runs;                /* the timer is not 0 */
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
         if :: timer_preset > 0 -> timer_runs = true :: else fi
      :: else
      fi;
)";

}  // namespace

Emission promela_of(std::span<const std::uint8_t> table, const std::vector<Property>& properties) {
    Emission emission;
    std::string claims;
    unsigned named = 0;
    for (const Property& property : properties) {
        const std::string bad = bad_scan(property);
        if (bad.empty()) {
            emission.left_out.push_back(property.name);
            continue;
        }
        named |= unsigned{image_bits_of(property.condition)} | image_bits_of(property.then);
        claims += fmt::format("\n/* {} */\n#define bad_{} (scanned && {})\nltl p_{} {{ [] !bad_{} }}\n",
                              property.text, property.name, bad, property.name, property.name);
    }
    const std::vector<ManualTerm> terms = manual_terms(table);
    unsigned used = named;
    for (const ManualTerm& term : terms) used |= term.compared;

    std::string declared;
    std::string chosen;
    std::string forgotten;
    std::string begun;
    for (unsigned bit = 0; bit < 8; ++bit) {
        if (((used >> bit) & 1U) == 0) continue;
        declared += fmt::format("bool {};\n", kBits[bit]);
        chosen += fmt::format("      if :: {0} = 0 :: {0} = 1 fi;\n", kBits[bit]);
        // What no property names need not be told apart.
        (((named >> bit) & 1U) != 0 ? begun : forgotten) += fmt::format(" {} = 0;", kBits[bit]);
    }
    emission.text = fmt::format(
        "{}{}\n{}\nactive proctype gateway() {{\n   do\n   :: atomic {{\n"
        "      d_step {{ scanned = false;{} }};\n"
        "      if :: timer_runs -> timer_runs = false :: skip fi;\n{}"
        "      d_step {{ next_step = 62; wrote = false; timer_preset = 0; counter_preset = 0 }};\n{}"
        "      d_step {{{}"
        "      next_step = 0; wrote = false; output_byte = 0; timer_preset = 0; counter_preset = 0;\n"
        "     {} scanned = true\n      }} }}\n   od\n}}\n{}",
        kPromelaHeader, kVariables, declared, begun, chosen, terms_text(terms), kExecution, forgotten,
        claims);
    return emission;
}

}  // namespace nplc::verify
