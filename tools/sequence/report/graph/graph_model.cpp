#include "report/graph/graph_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "base/crc32.h"
#include "report/graph/graph_ways.h"
#include "report/set_points_text.h"
#include "report/table_text.h"
#include "symbols/motors.h"

namespace nplc::seqc {
namespace {

constexpr std::size_t kWorthANote = 3;     // minimum number of steps with the same exit for a note
constexpr std::size_t kOfOnCondition = 2;  // the same for an ON condition
constexpr std::size_t kFewSteps = 3;
constexpr std::size_t kInputs = 6;

using Steps = GraphModel::Steps;

class Builder {
  public:
    Builder(const Machine& machine, const Symbols* symbols, const GraphSource& source)
        : machine_(machine), symbols_(symbols), source_(machine, symbols, source) {
        for_each_step([this](std::uint8_t step) { ways_[step] = source_.of(step); });
    }

    void build(GraphModel& model) {
        bundle_error(model.notes);
        while (bundle_first(model.notes) || bundle_inputs(model.notes)) {
        }
        for_each_step([&](std::uint8_t step) { model.boxes.push_back(box(step)); });
    }

  private:
    /// Condition, actions, target.
    using Key = std::tuple<std::string, std::string, std::uint8_t>;
    using Bundles = std::map<Key, Steps>;

    /// For each step with a box of its own.
    template <class Use>
    void for_each_step(Use use) const {
        for (std::uint8_t step = 0; step < kStepNumbers; ++step) {
            if (machine_.used.test(step) && !source_.drawn_with(step).empty()) use(step);
        }
    }

    static Key key_of(const GraphWays::Way& way) {
        return {way.shown.condition, way.shown.actions, way.shown.to};
    }

    /// Exits that are always taken on ERROR.
    void bundle_error(std::vector<GraphModel::Note>& notes) {
        Bundles bundles;
        for_each_step([&](std::uint8_t step) {
            for (const GraphWays::Way& way : ways_[step]) {
                if (is_plain_error(step, way)) bundles[key_of(way)].push_back(step);
            }
        });
        take(bundles, notes,
             [](std::uint8_t step, const GraphWays::Way& way) { return is_plain_error(step, way); });
    }

    static bool is_plain_error(std::uint8_t step, const GraphWays::Way& way) {
        return way.shown.to != step && way.when == truth_of_bit(kErrorBit);
    }

    /// The first branch that several steps of a program share.
    bool bundle_first(std::vector<GraphModel::Note>& notes) {
        Bundles bundles;
        for_each_step([&](std::uint8_t step) {
            if (is_first_written(step)) bundles[key_of(ways_[step].front())].push_back(step);
        });
        return take(bundles, notes, [this](std::uint8_t step, const GraphWays::Way& way) {
            return &way == &ways_[step].front();
        });
    }

    bool is_first_written(std::uint8_t step) const {
        if (step == 0 || ways_[step].empty()) return false;
        const GraphWays::Way& way = ways_[step].front();
        return way.is_written && way.shown.to != step && !is_for_the_rest(way.shown.condition);
    }

    static bool is_for_the_rest(std::string_view condition) {
        return condition == "always" || condition == "ELSE";
    }

    /// Makes a note of an exit that enough steps share, and removes it from their transitions.
    template <class Which>
    bool take(const Bundles& bundles, std::vector<GraphModel::Note>& notes, const Which& which) {
        const std::size_t before = notes.size();
        for (const auto& [key, steps] : bundles) {
            const bool is_on = source_.where_of(std::get<0>(key)).has_value();
            if (steps.size() < (is_on ? kOfOnCondition : kWorthANote)) continue;
            for (const std::uint8_t step : steps) {
                auto& ways = ways_[step];
                const auto taken =
                    std::find_if(ways.begin(), ways.end(), [&, &wanted = key](const GraphWays::Way& way) {
                        return key_of(way) == wanted && which(step, way);
                    });
                covered_[step] |= taken->when;
                ways.erase(taken);
            }
            const auto same = [&, &wanted = key](const auto& bundle) {
                return std::get<0>(bundle.first) == std::get<0>(wanted);
            };
            const bool is_only_one = std::count_if(bundles.begin(), bundles.end(), same) == 1;
            notes.push_back(note(key, steps, is_only_one));
        }
        return notes.size() > before;
    }

    /// `as_written`: the steps are named in the program's own words.
    GraphModel::Note note(const Key& key, const Steps& steps, bool as_written = true) const {
        const auto& [condition, actions, to] = key;
        const std::optional<std::string> written = as_written ? source_.where_of(condition) : std::nullopt;
        std::string in = where(steps, to, condition == "ERROR");
        if (written && !written->empty() && written->size() < in.size()) in = *written;
        return {{.condition = condition, .actions = actions, .to = to, .on_error = condition == "ERROR"}, in};
    }

    /// One input that leads several steps of a table to the same target, whatever the other conditions.
    bool bundle_inputs(std::vector<GraphModel::Note>& notes) {
        const std::size_t before = notes.size();
        for (std::size_t literal = 0; literal < 2 * kInputs; ++literal) bundle_input(literal, notes);
        return notes.size() > before;
    }

    Truth cases_of(std::size_t literal, std::uint8_t step) const {
        const Truth bit = truth_of_bit(literal / 2);
        return (literal % 2 == 0 ? bit : ~bit) & ~truth_of_bit(kErrorBit) & ~covered_[step];
    }

    void bundle_input(std::size_t literal, std::vector<GraphModel::Note>& notes) {
        const std::string condition = input_text(literal / 2, literal % 2 == 0, symbols_);
        Bundles bundles;
        for_each_step([&](std::uint8_t step) {
            for (const GraphWays::Way& way : ways_[step]) {
                if (has_all(step, way, cases_of(literal, step)))
                    bundles[{condition, way.shown.actions, way.shown.to}].push_back(step);
            }
        });
        for (const auto& [key, steps] : bundles) {
            if (steps.size() < kWorthANote) continue;
            notes.push_back(note(key, steps));
            for (const std::uint8_t step : steps) covered_[step] |= cases_of(literal, step);
            for (const std::uint8_t step : steps) shorten(step);
        }
    }

    static bool has_all(std::uint8_t step, const GraphWays::Way& way, const Truth& cases) {
        return !way.is_written && way.shown.to != step && step != 0 && cases.any() &&
               (cases & ~way.when).none();
    }

    /// Removes from a table's transitions what the notes say.
    void shorten(std::uint8_t step) {
        Truth told = covered_[step];
        for (GraphWays::Way& way : ways_[step]) {
            if (!way.is_written) {
                way.when &= ~covered_[step];
                way.shown.condition = condition_text(way.when, told, symbols_);
            }
            told |= way.when;
        }
        std::erase_if(ways_[step], [](const GraphWays::Way& way) { return way.when.none(); });
    }

    GraphModel::Box box(std::uint8_t step) const {
        const bool named =
            symbols_ != nullptr && step < symbols_->steps.size() && !symbols_->steps[step].empty();
        const Steps steps = source_.drawn_with(step);
        GraphModel::Box box{
            .step = step,
            .steps = steps,
            .name = step_name(step, symbols_),
            .shows_number = named,
            .reachable = std::any_of(steps.begin(), steps.end(),
                                     [this](std::uint8_t s) { return machine_.reachable.test(s); }),
            .made_as = source_.made_as(step),
            .is_of_compiler = false,
            .outputs = source_.outputs(step),
            .entry = source_.entry(step),
            .ways = {}};
        if (step != 0 && symbols_ != nullptr && (symbols_->set_points.takes >> step & 1U) != 0)
            box.outputs.emplace_back("TAKES SET_POINTS");
        box.is_of_compiler = !box.made_as.empty() && !box.made_as.starts_with("of SEQUENCE");
        for (const GraphWays::Way& way : ways_[step]) box.ways.push_back(way.shown);
        return box;
    }

    /// "in every step but Idle"
    std::string where(const Steps& steps, std::uint8_t target, bool from_power_up) const {
        Steps in;
        Steps but;
        for_each_step([&](std::uint8_t step) {
            const bool has = std::find(steps.begin(), steps.end(), step) != steps.end();
            if (!has && (step == target || (step == 0 && !from_power_up))) return;
            (has ? in : but).push_back(step);
        });
        if (but.empty()) return "in every other step";
        return but.size() <= kFewSteps ? "in every other step but " + names_of(but) : "in " + names_of(in);
    }

    /// "Idle, Work"; of steps without names "steps 3, 5 to 9".
    std::string names_of(const Steps& steps) const {
        std::string text;
        if (symbols_ != nullptr) {
            for (const std::uint8_t step : steps) append(text, step_name(step, symbols_), ", ");
            return text;
        }
        return numbers_text(steps);
    }

    const Machine& machine_;
    const Symbols* symbols_;
    GraphWays source_;
    std::array<std::vector<GraphWays::Way>, kStepNumbers> ways_;
    std::array<Truth, kStepNumbers> covered_;  ///< by notes
};

/// Only those named in the program.
template <class Names>
void add_terminals(std::string_view kind, const Names& names, GraphModel& model) {
    for (std::size_t i = 0; i < names.size(); ++i) {
        std::string terminal = fmt::format("{}{}", kind, i);
        if (!names[i].empty() && names[i] != terminal)
            model.terminals.emplace_back(std::move(terminal), names[i]);
    }
}

}  // namespace

std::string numbers_text(const GraphModel::Steps& steps) {
    std::string text;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        const std::size_t first = i;
        while (i + 1 < steps.size() && steps[i + 1] == steps[i] + 1) ++i;
        append(text,
               i == first ? fmt::format("{}", steps[i]) : fmt::format("{} to {}", steps[first], steps[i]),
               ", ");
    }
    return (steps.size() == 1 ? "step " : "steps ") + text;
}

GraphModel graph_model_of(std::span<const std::uint8_t> table, const Symbols* symbols,
                          const std::string& title, const GraphSource& source) {
    const Machine machine = machine_of(table);
    GraphModel model;
    const bool named = symbols != nullptr && !symbols->program.empty();
    model.title = named ? symbols->program : title;
    if (symbols != nullptr) model.motor = motor_name(*symbols);
    const std::size_t steps = machine.used.count();
    model.terms = machine.terms + 1;
    model.crc32 = base::crc32(table);
    model.footer = fmt::format("{} step{}, {} term{}, CRC-32 {:08X}", steps, steps == 1 ? "" : "s",
                               model.terms, model.terms == 1 ? "" : "s", model.crc32);
    if (symbols != nullptr) {
        std::array<std::string, 6> wires;
        for (std::size_t i = 0; i < wires.size(); ++i) wires[i] = wire_name(*symbols, i);
        add_terminals("IN", wires, model);
        add_terminals("OUT", symbols->outputs, model);
        for (const set_points::SetPoint& point : symbols->set_points.values)
            model.set_points.push_back(fmt::format("Set-point {}: {}", point.name, text_of(point)));
        if (const auto& scale = symbols->scale)
            model.scale = fmt::format("{:g} rev = {:g} {}", scale->revolutions, scale->length, scale->unit);
    }
    Builder(machine, symbols, source).build(model);
    return model;
}

std::string_view legend_of(const GraphModel& model) {
    const bool has_order = std::any_of(model.boxes.begin(), model.boxes.end(),
                                       [](const GraphModel::Box& box) { return box.ways.size() > 1; });
    if (!has_order) return {};
    return model.notes.empty()
               ? "in a step the first condition that holds counts"
               : "notes come before a step's own conditions; of these the first that holds counts";
}

}  // namespace nplc::seqc
