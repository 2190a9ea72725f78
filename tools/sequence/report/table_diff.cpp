#include "report/table_diff.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <utility>

#include "language/names.h"
#include "report/machine.h"
#include "report/power_up_values.h"
#include "report/table_text.h"
#include "seqc/seqc.h"
#include "sequencer/term.h"
#include "symbols/motors.h"

namespace nplc::seqc {

/// The corresponding steps of two tables.
struct StepMatch {
    std::array<std::optional<std::uint8_t>, kStepNumbers> now_of{};     ///< by number in the older table
    std::array<std::optional<std::uint8_t>, kStepNumbers> before_of{};  ///< by number in the newer table
};

/// Step 0 is step 0. Steps with names on both sides correspond by name; the others if they mostly behave the
/// same, which detects a renamed step. Without names on one side they correspond by number.
StepMatch match_steps(const Machine& before, const Symbols* names_before, const Machine& now,
                      const Symbols* names_now);

namespace {

std::string_view name_in(const Symbols* names, std::uint8_t step) {
    return names != nullptr && step < names->steps.size() ? std::string_view(names->steps[step]) : "";
}

class Matching {
  public:
    Matching(const Machine& before, const Symbols* names_before, const Machine& now, const Symbols* names_now)
        : before_(before), names_before_(names_before), now_(now), names_now_(names_now) {
        pair(0, 0);
        each_open([&](std::uint8_t a, std::uint8_t b) { return same_given_name(a, b); });
        each_open([&](std::uint8_t a, std::uint8_t b) { return a == b && !both_named(a, b); });
        each_open([&](std::uint8_t a, std::uint8_t b) { return a == b && mostly_same(a, b); });
        each_open([&](std::uint8_t a, std::uint8_t b) { return both_named(a, b) && mostly_same(a, b); });
    }

    const StepMatch& match() const { return match_; }

  private:
    void pair(std::uint8_t a, std::uint8_t b) {
        match_.now_of[a] = b;
        match_.before_of[b] = a;
    }

    template <class Same>
    void each_open(Same same) {
        for (std::uint8_t a = 0; a < kStepNumbers; ++a) {
            for (std::uint8_t b = 0; b < kStepNumbers; ++b) {
                const bool open =
                    before_.used.test(a) && now_.used.test(b) && !match_.now_of[a] && !match_.before_of[b];
                if (open && same(a, b)) pair(a, b);
            }
        }
    }

    bool both_named(std::uint8_t a, std::uint8_t b) const {
        return !name_in(names_before_, a).empty() && !name_in(names_now_, b).empty();
    }
    bool same_given_name(std::uint8_t a, std::uint8_t b) const {
        return both_named(a, b) && same_name(name_in(names_before_, a), name_in(names_now_, b));
    }

    /// In at least half of the cases in which one of them acts, both act the same, as far as the following
    /// steps are known to correspond.
    bool mostly_same(std::uint8_t a, std::uint8_t b) const {
        std::size_t acting = 0;
        std::size_t same = 0;
        for (std::size_t c = 0; c < kCases; ++c) {
            const table::Outcome& x = before_.steps[a].in(c);
            const table::Outcome& y = now_.steps[b].in(c);
            const bool stays = x.next == a && y.next == b;
            if (stays && x.is_quiet() && y.is_quiet()) continue;
            ++acting;
            const bool same_next = stays || (x.next != a && y.next != b && may_be_same(x.next, y.next));
            if (same_next && x.timer == y.timer && x.counter == y.counter && x.orders == y.orders) ++same;
        }
        return acting == 0 ? a == b : 2 * same >= acting;
    }
    bool may_be_same(std::uint8_t a, std::uint8_t b) const {
        return match_.now_of[a] ? match_.now_of[a] == b : !match_.before_of[b];
    }

    const Machine& before_;
    const Symbols* names_before_;
    const Machine& now_;
    const Symbols* names_now_;
    StepMatch match_;
};

}  // namespace

StepMatch match_steps(const Machine& before, const Symbols* names_before, const Machine& now,
                      const Symbols* names_now) {
    return Matching(before, names_before, now, names_now).match();
}

namespace {

using sequencer::MotorOrder;

std::string list_or_none(std::uint8_t outputs, const Symbols* symbols) {
    const std::string list = outputs_list(outputs, symbols);
    return list.empty() ? "none" : list;
}

/// One of the two tables.
struct ComparedTable {
    Machine machine;
    const Symbols* symbols;
    std::array<Entry, kStepNumbers> entries;

    explicit ComparedTable(const NamedTable& table)
        : machine(machine_of(table.table)), symbols(table.symbols) {
        for (std::uint8_t step = 0; step < kStepNumbers; ++step) {
            if (machine.used.test(step)) entries[step] = entry_of(machine, step);
        }
    }

    /// Outputs determined by the step itself: those with which the following step is entered, or those that a
    /// staying step always has. An unreachable step may enter it with others.
    std::uint8_t settled(std::uint8_t step, const table::Outcome& outcome) const {
        const KnownOutputs& always =
            outcome.next == step ? machine.held[step] : machine.entered_with[outcome.next];
        const KnownOutputs after = outputs_after(step, outcome);
        return static_cast<std::uint8_t>(always.known & after.known & ~(always.value ^ after.value));
    }
    KnownOutputs outputs_after(std::uint8_t step, const table::Outcome& outcome) const {
        constexpr std::uint8_t kAll = 0x0F;
        return outcome.outputs ? KnownOutputs{kAll, *outcome.outputs} : machine.held[step];
    }
    std::vector<MotorOrder> without_entry(const table::Outcome& outcome) const {
        std::vector<MotorOrder> orders = outcome.orders;
        orders.resize(orders.size() - entries[outcome.next].orders.size());
        return orders;
    }
};

class Differ {
  public:
    Differ(const NamedTable& before, const NamedTable& now)
        : before_(before),
          now_(now),
          names_(now.symbols != nullptr ? now.symbols : before.symbols),
          match_(match_steps(before_.machine, before.symbols, now_.machine, now.symbols)),
          values_(before_.machine, now_.machine) {
        diff_.same_bytes =
            std::equal(before.table.begin(), before.table.end(), now.table.begin(), now.table.end());
        if (before.symbols != nullptr && now.symbols != nullptr &&
            motor_name(*before.symbols) != motor_name(*now.symbols)) {
            diff_.motor_before = motor_name(*before.symbols);
            diff_.motor_now = motor_name(*now.symbols);
        }
        list_steps();
        diff_.values = values_.changes(before.symbols, now.symbols);
        for (std::uint8_t step = 0; step < kStepNumbers; ++step) {
            if (match_.before_of[step]) compare(*match_.before_of[step], step);
        }
        compare_takers(before.symbols, now.symbols);
        for (const std::uint8_t step : changed_entries_) add_entry(*match_.before_of[step], step);
    }

    TableDiff take() { return std::move(diff_); }

  private:
    std::string name_before(std::uint8_t step) const { return step_name(step, before_.symbols); }
    /// The name in the newer table, else in the older one.
    std::string name_now(std::uint8_t step) const {
        const Symbols* symbols = now_.symbols;
        const bool named =
            symbols != nullptr && step < symbols->steps.size() && !symbols->steps[step].empty();
        return !named && match_.before_of[step] ? name_before(*match_.before_of[step])
                                                : step_name(step, symbols);
    }

    void list_steps() {
        using Kind = TableDiff::Step::Kind;
        for (std::uint8_t step = 0; step < kStepNumbers; ++step) {
            const auto now = match_.now_of[step];
            if (!before_.machine.used.test(step)) continue;
            if (!now) {
                diff_.steps.push_back({Kind::removed, name_before(step), "", step, step});
            } else if (!has_same_name(step, *now)) {
                diff_.steps.push_back({Kind::renamed, name_before(step), name_now(*now), step, *now});
            } else if (*now != step) {
                diff_.steps.push_back({Kind::renumbered, name_before(step), name_now(*now), step, *now});
            }
        }
        for (std::uint8_t step = 0; step < kStepNumbers; ++step) {
            if (now_.machine.used.test(step) && !match_.before_of[step])
                diff_.steps.push_back({Kind::added, "", name_now(step), step, step});
        }
    }
    bool has_same_name(std::uint8_t before, std::uint8_t now) const {
        if (before_.symbols == nullptr || now_.symbols == nullptr) return true;
        return name_before(before) == name_now(now);
    }

    /// Only if both have set-points: otherwise the set-points are reported.
    void compare_takers(const Symbols* before, const Symbols* now) {
        if (before == nullptr || now == nullptr) return;
        const set_points::Record& old = before->set_points;
        const set_points::Record& young = now->set_points;
        if (old.values.empty() || young.values.empty()) return;
        const auto takes = [](const set_points::Record& record, std::optional<std::uint8_t> step) {
            return step && (record.takes >> *step & 1U) != 0;
        };
        for (std::uint8_t step = 0; step < kStepNumbers; ++step) {
            const auto earlier = match_.before_of[step];
            if (takes(young, step) && !takes(old, earlier)) diff_.take_now.push_back(name_now(step));
            if (earlier && takes(old, earlier) && !takes(young, step))
                diff_.take_no_more.push_back(name_now(step));
        }
    }

    void compare(std::uint8_t a, std::uint8_t b) {
        compare_outputs(a, b);
        std::vector<std::pair<StepAction, StepAction>> kinds;
        std::vector<Truth> cases;
        for (std::size_t c = 0; c < kCases; ++c) {
            auto [before, now] = actions(a, b, c);
            if (before == now || is_only_entry(a, b, c, before, now)) continue;
            const auto found = std::find(kinds.begin(), kinds.end(), std::pair(before, now));
            const auto index = static_cast<std::size_t>(found - kinds.begin());
            if (found == kinds.end()) {
                kinds.emplace_back(std::move(before), std::move(now));
                cases.emplace_back();
            }
            cases[index].set(c);
        }
        for (std::size_t i = 0; i < kinds.size(); ++i) {
            diff_.reactions.push_back({name_now(b), condition_text(cases[i], {}, names_),
                                       text_of(kinds[i].second, names_), text_of(kinds[i].first, names_)});
        }
    }

    std::pair<StepAction, StepAction> actions(std::uint8_t a, std::uint8_t b, std::size_t c) const {
        const table::Outcome& x = before_.machine.steps[a].in(c);
        const table::Outcome& y = now_.machine.steps[b].in(c);
        std::pair<StepAction, StepAction> result{step_action_of(x, c), step_action_of(y, c)};
        auto& [before, now] = result;
        if (x.next != a) name_target_before(x.next, before);
        if (y.next != b) {
            now.next_id = y.next;
            now.next = name_now(y.next);
        }
        if (b == 0) values_.level(before.orders, now.orders);
        const auto settled = static_cast<std::uint8_t>(before_.settled(a, x) & now_.settled(b, y));
        tell_outputs(before_.outputs_after(a, x), now_.outputs_after(b, y), settled, result);
        return result;
    }

    static void tell_outputs(const KnownOutputs& before, const KnownOutputs& now, std::uint8_t settled,
                             std::pair<StepAction, StepAction>& actions) {
        const auto differ =
            static_cast<std::uint8_t>(((before.known ^ now.known) | (before.value ^ now.value)) & ~settled);
        const auto tell = [differ](const KnownOutputs& outputs, StepAction& action) {
            action.outputs = {static_cast<std::uint8_t>(outputs.known & differ),
                              static_cast<std::uint8_t>(outputs.value & differ)};
            action.kept_outputs = static_cast<std::uint8_t>(differ & ~outputs.known);
        };
        tell(before, actions.first);
        tell(now, actions.second);
    }

    void name_target_before(std::uint8_t step, StepAction& action) const {
        const auto now = match_.now_of[step];
        action.next_id = now ? *now : static_cast<int>(kStepNumbers) + step;
        action.next = now ? name_now(*now) : name_before(step);
    }

    /// Both lead to the same step and differ only in the common action of all transitions into it.
    bool is_only_entry(std::uint8_t a, std::uint8_t b, std::size_t c, StepAction before, StepAction now) {
        if (before.next_id < 0 || before.next_id != now.next_id) return false;
        before.orders = before_.without_entry(before_.machine.steps[a].in(c));
        now.orders = now_.without_entry(now_.machine.steps[b].in(c));
        if (b == 0) values_.level(before.orders, now.orders);
        if (before != now) return false;
        const auto target = static_cast<std::uint8_t>(now.next_id);
        if (std::find(changed_entries_.begin(), changed_entries_.end(), target) == changed_entries_.end())
            changed_entries_.push_back(target);
        return true;
    }

    void add_entry(std::uint8_t a, std::uint8_t b) {
        StepAction before;
        StepAction now;
        before.orders = before_.entries[a].orders;
        now.orders = now_.entries[b].orders;
        diff_.entries.push_back({name_now(b), "entered", text_of(now, names_), text_of(before, names_)});
    }

    void compare_outputs(std::uint8_t a, std::uint8_t b) {
        const KnownOutputs& held_before = before_.machine.held[a];
        const KnownOutputs& held_now = now_.machine.held[b];
        const KnownOutputs& entered_before = before_.machine.entered_with[a];
        const KnownOutputs& entered_now = now_.machine.entered_with[b];
        add_outputs(b, "", held_before, held_now);
        if (diff_.outputs.empty() || diff_.outputs.back().step != name_now(b))
            add_outputs(b, "entered", entered_before, entered_now);
    }

    void add_outputs(std::uint8_t b, const std::string& when, const KnownOutputs& before,
                     const KnownOutputs& now) {
        const auto both = static_cast<std::uint8_t>(before.known & now.known);
        if (((before.value ^ now.value) & both) == 0) return;
        diff_.outputs.push_back({name_now(b), when, "OUT " + list_or_none(now.value & both, names_),
                                 list_or_none(before.value & both, names_)});
    }

    ComparedTable before_;
    ComparedTable now_;
    const Symbols* names_;  ///< of signals
    StepMatch match_;
    PowerUpValues values_;
    TableDiff diff_;
    std::vector<std::uint8_t> changed_entries_;
};

}  // namespace

bool TableDiff::same_behaviour() const {
    const auto counts = [](const Step& step) {
        return step.kind == Step::Kind::added || step.kind == Step::Kind::removed;
    };
    return set_points.empty() && take_now.empty() && take_no_more.empty() && values.empty() &&
           outputs.empty() && entries.empty() && reactions.empty() &&
           std::none_of(steps.begin(), steps.end(), counts);
}

TableDiff diff_of(const NamedTable& before, const NamedTable& now) {
    TableDiff diff = Differ(before, now).take();
    diff.set_points = set_point_changes(before.symbols, now.symbols);
    return diff;
}

}  // namespace nplc::seqc
