#include "report/table_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "compiler/model.h"
#include "report/set_points_text.h"
#include "report/table_text.h"
#include "sequencer/term.h"
#include "symbols/motors.h"
#include "symbols/set_points_json.h"

namespace nplc::seqc {
namespace {

TableReport::Transition transition_of(std::uint8_t from, const StepTransition& reaction,
                                      const Symbols* symbols, bool safe) {
    TableReport::Transition transition;
    transition.from = from;
    transition.to = reaction.outcome.next;
    transition.when = reaction.when;
    for (const auto& order : reaction.outcome.orders) transition.orders.push_back(order_text(order, symbols));
    transition.line = line_use(reaction.outcome.orders, safe);
    return transition;
}

void add_step(const Machine& machine, std::uint8_t step, const Symbols* symbols, TableReport& report) {
    if (!machine.used.test(step)) return;
    report.steps.push_back(
        {step, step_name(step, symbols), machine.steps[step].terms, machine.reachable.test(step)});
    for (const StepTransition& reaction : reactions_of(machine, step)) {
        if (reaction.outcome.next == step && reaction.outcome.orders.empty()) continue;
        report.transitions.push_back(
            transition_of(step, reaction, symbols, report.settings.safe_communication));
    }
}

}  // namespace

TableReport report_of(std::span<const std::uint8_t> table, const Symbols* symbols,
                      const LineSettings& settings) {
    const Machine machine = machine_of(table);
    TableReport report;
    if (symbols != nullptr) report.symbols = *symbols;
    report.has_power_up = symbols != nullptr && !symbols->steps[0].empty();
    report.settings = settings;
    report.terms = machine.terms + 1;
    for (std::uint8_t step = 0; step < sequencer::kEndOfTable; ++step)
        add_step(machine, step, symbols, report);
    std::stable_sort(report.transitions.begin(), report.transitions.end(),
                     [](const auto& a, const auto& b) { return a.line.until_done > b.line.until_done; });
    return report;
}

namespace {

using Json = nlohmann::ordered_json;
using ReportStep = TableReport::Step;
using Transition = TableReport::Transition;

constexpr std::size_t kNamedAsWorst = 3;
constexpr std::size_t kStepsOfTable = 62;  // 0..61; 62 cannot be a target

std::size_t steps_used(const TableReport& report) {
    return report.steps.size() - (report.has_power_up ? 1 : 0);
}

std::size_t most_steps(const TableReport& report) {
    return report.has_power_up ? kMostSteps : kStepsOfTable;
}

std::size_t free_terms(const TableReport& report) {
    return kTermsEverywhere - std::min(kTermsEverywhere, report.terms);
}

std::string_view motor_of(const TableReport& report) {
    return report.symbols ? motor_name(*report.symbols) : "";
}

std::string condition_of(const Transition& transition, const TableReport& report) {
    return condition_text(transition.when, {}, report.symbols ? &*report.symbols : nullptr);
}

const std::string& name_of(const TableReport& report, std::uint8_t step) {
    static const std::string kNone = "step 63";
    for (const ReportStep& known : report.steps) {
        if (known.number == step) return known.name;
    }
    return kNone;
}

std::vector<ReportStep> worst_first(std::vector<ReportStep> steps) {
    std::stable_sort(steps.begin(), steps.end(),
                     [](const ReportStep& a, const ReportStep& b) { return a.terms > b.terms; });
    return steps;
}

/// Why the compiler generated the step; empty: it is in the program.
std::string made_for(const TableReport& report, std::uint8_t step) {
    return report.symbols && step <= kMostSteps ? report.symbols->made_for[step] : std::string();
}

std::string room_text(const TableReport& report) {
    const auto is_of_sequence = [&](const ReportStep& step) {
        return made_for(report, step.number).starts_with("of SEQUENCE");
    };
    const auto of_sequences = std::count_if(report.steps.begin(), report.steps.end(), is_of_sequence);
    const auto made = std::count_if(report.steps.begin(), report.steps.end(), [&](const ReportStep& step) {
        return !made_for(report, step.number).empty() && !is_of_sequence(step);
    });
    std::string text = fmt::format("steps  {} of {}{}{}{}\n", steps_used(report), most_steps(report),
                                   report.has_power_up ? ", and POWER_UP" : "",
                                   of_sequences == 0 ? "" : fmt::format("; {} of SEQUENCEs", of_sequences),
                                   made == 0 ? "" : fmt::format("; {} made by the compiler", made));
    text += fmt::format("terms  {} of {}, the end included; {} of {} bytes\n", report.terms, kTermsEverywhere,
                        report.terms * sequencer::kTermBytes, kTermsEverywhere * sequencer::kTermBytes);
    if (report.terms > kTermsEverywhere) {
        text += fmt::format("       {} more than every gateway holds\n", report.terms - kTermsEverywhere);
    } else {
        text += fmt::format("       {} free\n", free_terms(report));
    }
    std::string worst;
    for (const ReportStep& step : worst_first(report.steps)) {
        if (step.terms == 0) break;
        append(worst, fmt::format("{} {}", step.name, step.terms), ", ");
        if (static_cast<std::size_t>(std::count(worst.begin(), worst.end(), ',')) + 1 == kNamedAsWorst) break;
    }
    if (!worst.empty()) text += fmt::format("       most in {}\n", worst);
    return text;
}

std::string steps_text(const TableReport& report) {
    std::string text = "\n step  terms  name\n";
    for (const ReportStep& step : report.steps) {
        const std::string why = made_for(report, step.number);
        text += fmt::format("{:5}  {:5}  {}{}{}{}\n", step.number, step.terms, step.name,
                            step.reachable ? "" : " (never reached)", why.empty() ? "" : "  ", why);
    }
    return text;
}

std::string joined(const std::vector<std::string>& parts) {
    std::string text;
    for (const std::string& part : parts) append(text, part, "; ");
    return text;
}

std::string way_text(const Transition& transition, const TableReport& report) {
    const bool stays = transition.from == transition.to;
    return fmt::format("{:38}{}{}, {}\n", "", name_of(report, transition.from),
                       stays ? " in every scan" : " -> " + name_of(report, transition.to),
                       condition_of(transition, report));
}

/// The orders of the transition, and all transitions with the same orders.
std::string group_text(const Transition& transition, const TableReport& report) {
    const auto ms = [&](std::uint32_t characters) { return milliseconds(characters, report.settings.baud); };
    const LineUse& line = transition.line;
    std::string text =
        fmt::format("{:6} {:9.2f}   {:7.2f} to {:<6.2f}  {}\n", line.characters, ms(line.characters),
                    ms(line.until_done), ms(line.at_most), joined(transition.orders));
    for (const Transition& other : report.transitions) {
        if (other.orders == transition.orders) text += way_text(other, report);
    }
    return text;
}

const Transition* longest_from_start(const TableReport& report) {
    for (const Transition& transition : report.transitions) {
        if (transition.from == 0 && !transition.orders.empty()) return &transition;
    }
    return nullptr;
}

/// The times apply to FastMAC and FlexMAC only.
bool is_translated(const TableReport& report) {
    return report.symbols && report.symbols->drive != nullptr;
}

std::string line_heading(const TableReport& report) {
    if (is_translated(report))
        return fmt::format("\nhow long a {} drive's line is kept is not worked out\n",
                           report.symbols->drive->family->name());
    const auto ms = [&](std::uint32_t characters) { return milliseconds(characters, report.settings.baud); };
    std::string text = fmt::format("\nmotor's line at {} baud, {} communication\n", report.settings.baud,
                                   report.settings.safe_communication ? "safe" : "rapid");
    if (const Transition* start = longest_from_start(report)) {
        text += fmt::format("{} takes {:.2f} to {:.2f} ms: {} orders, {} characters\n", name_of(report, 0),
                            ms(start->line.until_done), ms(start->line.at_most), start->orders.size(),
                            start->line.characters);
    }
    return text;
}

std::string line_text(const TableReport& report) {
    std::string text = line_heading(report);
    if (is_translated(report)) return text;
    text += "\n chars   line ms   until done, ms    sent\n";
    std::size_t silent = 0;
    std::set<std::vector<std::string>> seen;
    for (const Transition& transition : report.transitions) {
        if (transition.orders.empty()) {
            ++silent;
        } else if (seen.insert(transition.orders).second) {
            text += group_text(transition, report);
        }
    }
    const bool one = silent == 1;
    text += fmt::format("{} switch{} {} nothing\n", silent, one ? "" : "es", one ? "sends" : "send");
    return text;
}

Json json_of(const Transition& transition, const TableReport& report) {
    const auto ms = [&](std::uint32_t characters) { return milliseconds(characters, report.settings.baud); };
    const LineUse& line = transition.line;
    Json json{{"from", transition.from},
              {"to", transition.to},
              {"condition", condition_of(transition, report)},
              {"orders", transition.orders}};
    if (is_translated(report)) return json;
    json["messages"] = line.messages;
    json["characters"] = line.characters;
    json["line_ms"] = ms(line.characters);
    json["until_done_ms"] = ms(line.until_done);
    json["at_most_ms"] = ms(line.at_most);
    return json;
}

}  // namespace

std::string text_of(const TableReport& report) {
    std::string text;
    if (report.symbols) text = fmt::format("program {}, {}\n", report.symbols->program, motor_of(report));
    return text + room_text(report) + steps_text(report) +
           (report.symbols ? set_points_text(*report.symbols) : std::string()) + line_text(report);
}

std::string summary_of(const TableReport& report) {
    std::string text = room_text(report) + line_heading(report);
    const auto later = std::find_if(report.transitions.begin(), report.transitions.end(),
                                    [](const Transition& t) { return t.from != 0 && !t.orders.empty(); });
    if (later == report.transitions.end() || is_translated(report)) return text;
    const auto ms = [&](std::uint32_t characters) { return milliseconds(characters, report.settings.baud); };
    return text + fmt::format("longest after it: {} -> {}, {}: {:.2f} to {:.2f} ms\n",
                              name_of(report, later->from), name_of(report, later->to),
                              condition_of(*later, report), ms(later->line.until_done),
                              ms(later->line.at_most));
}

std::string json_of(const TableReport& report) {
    Json json{{"program", report.symbols ? report.symbols->program : ""},
              {"motor", motor_of(report)},
              {"steps_used", steps_used(report)},
              {"steps_most", most_steps(report)},
              {"terms", report.terms},
              {"terms_most", kTermsEverywhere},
              {"terms_free", free_terms(report)},
              {"bytes", report.terms * sequencer::kTermBytes},
              {"baud", report.settings.baud},
              {"safe_communication", report.settings.safe_communication}};
    json["steps"] = Json::array();
    for (const ReportStep& step : report.steps) {
        json["steps"].push_back({{"number", step.number},
                                 {"name", step.name},
                                 {"terms", step.terms},
                                 {"reachable", step.reachable}});
        const std::string why = made_for(report, step.number);
        if (!why.empty()) json["steps"].back()["made_for"] = why;
    }
    if (report.symbols && !report.symbols->set_points.values.empty()) {
        json["set_points"] = json_of(report.symbols->set_points);
        json["takes_set_points"] = takes_of(report.symbols->set_points);
    }
    json["transitions"] = Json::array();
    for (const Transition& transition : report.transitions)
        json["transitions"].push_back(json_of(transition, report));
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace nplc::seqc
