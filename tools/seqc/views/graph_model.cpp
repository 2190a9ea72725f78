#include "views/graph_model.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/crc32.h"
#include "semantics/motors.h"
#include "views/table_text.h"

namespace nplc::seqc {
namespace {

using Arrow = GraphModel::Arrow;
using Box = GraphModel::Box;

constexpr std::size_t kWorthANote = 3;  // steps with the same way out on ERROR
constexpr std::size_t kFewSteps = 3;
constexpr int kFarBack = 2;

std::string joined(const std::vector<std::string>& parts, std::string_view separator) {
    std::string text;
    for (const std::string& part : parts) append(text, part, separator);
    return text;
}

/// Always on ERROR, and out of the step.
bool is_plain_error(std::uint8_t step, const Reaction& reaction) {
    return reaction.outcome.next != step && reaction.when == truth_of_bit(kErrorBit);
}

class Builder {
  public:
    Builder(const Machine& machine, const Symbols* symbols)
        : machine_(machine), symbols_(symbols), power_up_(power_up_orders(machine_)) {
        for_each_step([this](std::uint8_t step) {
            reactions_[step] = reactions_of(machine_, step);
            entries_[step] = entry_of(machine_, step);
        });
        for_each_step([this](std::uint8_t step) {
            for (const Reaction& reaction : reactions_[step]) {
                if (is_plain_error(step, reaction)) error_ways_[error_way(step, reaction)].push_back(step);
            }
        });
        std::erase_if(error_ways_, [](const auto& way) { return way.second.size() < kWorthANote; });
    }

    void build(GraphModel& model) const {
        for_each_step([&](std::uint8_t step) {
            model.boxes.push_back(box(step));
            add_arrows(step, model.arrows);
        });
        for (const auto& [way, steps] : error_ways_)
            model.notes.push_back({way.first, where(steps, way.first), way.second});
        mark_far_back(model.arrows);
    }

  private:
    /// Where ERROR leads, and what is done on the way.
    using ErrorWay = std::pair<std::uint8_t, std::string>;

    template <class Use>
    void for_each_step(Use use) const {
        for (std::uint8_t step = 0; step < kStepNumbers; ++step) {
            if (machine_.used.test(step)) use(step);
        }
    }

    ErrorWay error_way(std::uint8_t step, const Reaction& reaction) const {
        return {reaction.outcome.next, actions(step, reaction)};
    }

    bool has_note(std::uint8_t step, const Reaction& reaction) const {
        return is_plain_error(step, reaction) && error_ways_.contains(error_way(step, reaction));
    }

    std::string actions(std::uint8_t step, const Reaction& reaction) const {
        ScanResult outcome = reaction.outcome;
        auto& orders = outcome.orders;
        if (outcome.next != step) {
            const Entry& entry = entries_[outcome.next];
            orders.resize(orders.size() - entry.orders.size());
            if (entry.timer != 0) outcome.timer = 0;
            if (entry.counter_preset != 0) outcome.counter = CounterChange::none;
            if (step == 0)
                orders.erase(orders.begin(), orders.begin() + static_cast<std::ptrdiff_t>(power_up_.size()));
        }
        std::vector<std::string> parts = action_texts(outcome, symbols_);
        for (std::uint8_t bit = 0; bit < 4; ++bit) {
            if (((reaction.outputs_shown >> bit) & 1) == 0) continue;
            const bool on = ((*outcome.outputs >> bit) & 1) != 0;
            parts.push_back(fmt::format("{} {}", output_name(bit, symbols_), on ? "on" : "off"));
        }
        return joined(parts, "; ");
    }

    Box box(std::uint8_t step) const {
        const bool named =
            symbols_ != nullptr && step < symbols_->steps.size() && !symbols_->steps[step].empty();
        Box box{.step = step,
                .name = step_name(step, symbols_),
                .shows_number = named,
                .reachable = machine_.reachable.test(step),
                .outputs = outputs(step),
                .entry = entry(step),
                .every_scan = {}};
        for (const Reaction& reaction : reactions_[step]) {
            if (reaction.outcome.next != step) continue;
            box.every_scan.push_back({condition_text(reaction.when, {}, symbols_), actions(step, reaction)});
        }
        return box;
    }

    std::vector<std::string> outputs(std::uint8_t step) const {
        using Kind = OutputRule::Kind;
        std::string always_on;
        std::vector<std::string> texts;
        for (const OutputRule& rule : output_rules(machine_, step)) {
            const std::string name = output_name(rule.bit, symbols_);
            if (rule.kind == Kind::on) {
                append(always_on, name, ", ");
                continue;
            }
            const std::string_view verb = rule.kind == Kind::sets     ? "set"
                                          : rule.kind == Kind::resets ? "reset"
                                                                      : "OUT";
            texts.push_back(
                fmt::format("{} {} WHEN {}", verb, name, condition_text(rule.when, rule.open, symbols_)));
        }
        if (!always_on.empty()) texts.insert(texts.begin(), "OUT " + always_on);
        return texts;
    }

    std::string entry(std::uint8_t step) const {
        const Entry& entry = entries_[step];
        ScanResult outcome;
        outcome.orders = step == 0 ? power_up_ : entry.orders;
        outcome.timer = entry.timer;
        outcome.counter_preset = entry.counter_preset;
        if (entry.counter_preset != 0) outcome.counter = CounterChange::preset;
        const std::string text = joined(action_texts(outcome, symbols_), "; ");
        return text.empty() || step == 0 ? text : "ENTRY " + text;
    }

    void add_arrows(std::uint8_t step, std::vector<Arrow>& arrows) const {
        for (const Reaction& reaction : reactions_[step]) {
            if (reaction.outcome.next == step || has_note(step, reaction)) continue;
            const Arrow wanted{
                .from = step, .to = reaction.outcome.next, .on_error = reaction.only_on_error(), .ways = {}};
            auto arrow = std::find_if(arrows.begin(), arrows.end(), [&](const Arrow& a) {
                return a.from == wanted.from && a.to == wanted.to && a.on_error == wanted.on_error;
            });
            if (arrow == arrows.end()) arrow = arrows.insert(arrow, wanted);
            arrow->ways.push_back({condition_text(reaction.when, {}, symbols_), actions(step, reaction)});
        }
    }

    /// "in every step but Idle"
    std::string where(const std::vector<std::uint8_t>& steps, std::uint8_t target) const {
        std::string in;
        std::string but;
        std::size_t left_out = 0;
        for_each_step([&](std::uint8_t step) {
            const bool has = std::find(steps.begin(), steps.end(), step) != steps.end();
            if (!has && step == target) return;
            append(has ? in : but, step_name(step, symbols_), ", ");
            if (!has) ++left_out;
        });
        if (left_out == 0) return "in every other step";
        return left_out <= kFewSteps ? "in every other step but " + but : "in " + in;
    }

    /// By the arrows between power-up and each step.
    void mark_far_back(std::vector<Arrow>& arrows) const {
        std::array<int, kStepNumbers> depth{};
        depth.fill(-1);
        depth[0] = 0;
        std::vector<std::uint8_t> open{0};
        for (std::size_t i = 0; i < open.size(); ++i) {
            for (const Arrow& arrow : arrows) {
                if (arrow.from != open[i] || depth[arrow.to] >= 0) continue;
                depth[arrow.to] = depth[arrow.from] + 1;
                open.push_back(arrow.to);
            }
        }
        for (Arrow& arrow : arrows)
            arrow.leads_far_back = depth[arrow.to] >= 0 && depth[arrow.from] - depth[arrow.to] >= kFarBack;
    }

    const Machine& machine_;
    const Symbols* symbols_;
    std::vector<sequencer::MotorOrder> power_up_;
    std::array<std::vector<Reaction>, kStepNumbers> reactions_;
    std::array<Entry, kStepNumbers> entries_;
    std::map<ErrorWay, std::vector<std::uint8_t>> error_ways_;
};

}  // namespace

GraphModel graph_model_of(std::span<const std::uint8_t> table, const Symbols* symbols,
                          const std::string& title) {
    const Machine machine = machine_of(table);
    GraphModel model;
    const bool named = symbols != nullptr && !symbols->program.empty();
    model.title = named ? symbols->program : title;
    if (symbols != nullptr) model.motor = motor_name(*symbols);
    const std::size_t steps = machine.used.count();
    const std::size_t terms = machine.terms + 1;
    model.footer = fmt::format("{} step{}, {} term{}, CRC-32 {:08X}", steps, steps == 1 ? "" : "s", terms,
                               terms == 1 ? "" : "s", base::crc32(table));
    Builder(machine, symbols).build(model);
    return model;
}

}  // namespace nplc::seqc
