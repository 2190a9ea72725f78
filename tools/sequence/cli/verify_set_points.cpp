#include "cli/verify_set_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "sequencer/table.h"
#include "sequencer/term.h"
#include "set_points/values.h"
#include "table/step.h"
#include "table/terms.h"

namespace nplc::seqc::cli {
namespace {

using set_points::SetPoint;
using set_points::ValueKind;
using verify::Result;
using verify::Verdict;

/// Number of single counts that are tried if the explorer leaves a verdict undecided, and how many of them
/// may again be undecided.
constexpr std::size_t kMostCounts = 1024;
constexpr std::size_t kMostOpen = 16;
/// Above it single counts are tried before the explorer takes all of them.
constexpr std::size_t kFewCounts = 64;
/// Number of values whose range limits are combined completely.
constexpr std::size_t kMostCombined = 3;

/// One preset for each set-point of a time or a count.
using Presets = std::vector<std::int32_t>;

bool is_same(const Result& a, const Result& b) {
    return a.name == b.name && a.code == b.code && a.step == b.step;
}

class AllValues {
  public:
    AllValues(std::span<const std::uint8_t> table, const set_points::Record& record,
              const verify::Names& names, const std::vector<verify::Property>& properties,
              const verify::Options& how)
        : table_(table.begin(), table.end()), names_(names), properties_(properties), how_(how) {
        for (const SetPoint& point : record.values) {
            if (point.kind != ValueKind::motor_register) {
                points_.push_back(point);
            } else if (point.lowest <= 0 && point.highest >= 0) {
                how_.may_be_zero.push_back(point.reg);
            }
        }
        for (const SetPoint& point : points_) defaults_.push_back(point.initial);
    }

    verify::Report run() {
        const verify::Report own = verified(defaults_, properties_, how_);
        if (points_.empty()) return own;
        if (find_marks()) {
            std::vector<std::optional<Result>> broken = broken_with_few(own);
            report_ = verified(marks_, left_of(broken), ranged(true));
            for (Result& result : report_.results) name_values(result);
            join(std::move(broken));
        } else {
            report_ = own;
        }
        note_broken(own, nullptr);
        try_ends();
        if (!marks_.empty()) try_counts();
        return std::move(report_);
    }

  private:
    bool is_count(std::size_t i) const { return points_[i].kind == ValueKind::counter; }

    /// Finds presets that no term has, for counters above every possible counter value; false if there are
    /// none.
    bool find_marks() {
        std::set<std::int32_t> used;
        std::int32_t greatest = 0;
        for (const sequencer::TermView bytes : table::terms_of(table_)) {
            const table::ValuePlace::Kind kind = table::value_place(bytes).kind;
            if (kind == table::ValuePlace::Kind::reg) continue;
            const auto preset = static_cast<std::int32_t>(table::value_of(bytes));
            used.insert(preset);
            if (kind == table::ValuePlace::Kind::counter) greatest = std::max(greatest, preset);
        }
        for (std::size_t i = 0; i < points_.size(); ++i) {
            if (is_count(i)) greatest = std::max(greatest, points_[i].highest);
        }
        Presets marks;
        std::int32_t next = kMostPreset;
        for (std::size_t i = 0; i < points_.size(); ++i) {
            while (used.contains(next)) --next;
            if (is_count(i) && next <= greatest) return false;
            marks.push_back(next--);
        }
        // A counter is looked up by its value, so its marks are as low as possible.
        for (std::size_t i = 0; i < points_.size(); ++i) {
            if (!is_count(i)) continue;
            do ++greatest;
            while (used.contains(greatest));
            marks[i] = greatest;
        }
        marks_ = std::move(marks);
        return true;
    }

    verify::Options ranged(bool counts) const {
        verify::Options options = how_;
        for (std::size_t i = 0; i < points_.size(); ++i) {
            if (is_count(i) && !counts) continue;
            auto& ranges = is_count(i) ? options.ranges.counter : options.ranges.timer;
            ranges.push_back({static_cast<std::uint16_t>(marks_[i]),
                              static_cast<std::uint16_t>(points_[i].lowest),
                              static_cast<std::uint16_t>(points_[i].highest)});
        }
        return options;
    }

    /// What large ranges of counts break is mostly seen with a few parts: a course of few scans, and explored
    /// without a state for each count. One for each property, if it is broken.
    std::vector<std::optional<Result>> broken_with_few(const verify::Report& own) const {
        std::vector<std::optional<Result>> broken(properties_.size());
        if (count_of_counts() <= kFewCounts) return broken;
        take_broken(broken, own, nullptr);
        verify::Options options = ranged(false);
        options.checks = false;
        for (const std::int32_t more : {0, 1, 2, 3}) {
            Presets values = marks_;
            Presets shown = defaults_;
            for (std::size_t i = 0; i < points_.size(); ++i) {
                if (!is_count(i)) continue;
                values[i] = shown[i] = std::min(points_[i].lowest + more, points_[i].highest);
            }
            take_broken(broken, verified(values, left_of(broken), options), &shown);
        }
        return broken;
    }

    /// The results of `tried` are those of the properties that are left, in order.
    void take_broken(std::vector<std::optional<Result>>& broken, const verify::Report& tried,
                     const Presets* values) const {
        std::vector<std::size_t> left;
        for (std::size_t i = 0; i < broken.size(); ++i) {
            if (!broken[i]) left.push_back(i);
        }
        std::size_t next = 0;
        for (const Result& result : tried.results) {
            if (!result.code.empty()) continue;
            const std::size_t property = left[next++];
            if (result.verdict != Verdict::broken) continue;
            broken[property] = result;
            if (values != nullptr) add_values(*broken[property], values_in(result, *values));
        }
    }

    std::vector<verify::Property> left_of(const std::vector<std::optional<Result>>& broken) const {
        std::vector<verify::Property> left;
        for (std::size_t i = 0; i < broken.size(); ++i) {
            if (!broken[i]) left.push_back(properties_[i]);
        }
        return left;
    }

    /// Into the report, in the order of the properties.
    void join(std::vector<std::optional<Result>> broken) {
        auto at = std::find_if(report_.results.begin(), report_.results.end(),
                               [](const Result& result) { return result.code.empty(); });
        for (std::optional<Result>& result : broken) {
            if (result) at = report_.results.insert(at, std::move(*result));
            ++at;
        }
    }

    /// Adds the values with which a course found with ranges breaks the property.
    void name_values(Result& result) const {
        if (result.verdict == Verdict::broken && !result.presets.empty())
            add_values(result, values_in(result, defaults_));
    }

    Presets values_in(const Result& result, Presets values) const {
        for (const verify::ChosenPreset& one : result.presets) {
            for (std::size_t i = 0; i < marks_.size(); ++i) {
                if (marks_[i] == one.preset) values[i] = one.chosen;
            }
        }
        return values;
    }

    void add_values(Result& result, const Presets& values) const {
        std::string text;
        result.set_values.clear();
        for (std::size_t i = 0; i < points_.size(); ++i) {
            const SetPoint& point = points_[i];
            const std::string value = set_points::text_of(point, values[i]);
            text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", point.name, value);
            if (values[i] == defaults_[i]) continue;
            result.set_values.push_back(
                {point.name, value, static_cast<std::uint16_t>(values[i]), point.places});
        }
        result.reason += fmt::format("{}with {}", result.reason.empty() ? "" : ", ", text);
    }

    /// Records what breaks with these values (null: the table's own) unless it is known to break with simpler
    /// ones.
    void note_broken(const verify::Report& tried, const Presets* values) {
        for (const Result& result : tried.results) {
            // A step that is unreachable with some values may be reachable with others.
            if (result.verdict != Verdict::broken || result.code == "V001") continue;
            Result found = result;
            const bool is_unreachable = result.code.empty() && !result.course;
            if (values != nullptr || is_unreachable)
                add_values(found, values != nullptr ? *values : defaults_);
            const auto end = report_.results.end();
            const auto known = std::find_if(report_.results.begin(), end,
                                            [&](const Result& r) { return is_same(r, result); });
            if (known != end) {
                if (values == nullptr || known->verdict != Verdict::broken) *known = std::move(found);
                continue;
            }
            const auto check = std::find_if(report_.results.begin(), end, [&](const Result& r) {
                return r.code == result.code && !r.code.empty();
            });
            if (check != end && check->verdict == Verdict::proved)
                *check = std::move(found);
            else
                report_.results.insert(check, std::move(found));
        }
    }

    std::vector<verify::Property> open_properties() const {
        std::vector<verify::Property> open;
        for (const verify::Property& property : properties_) {
            const bool is_open =
                std::any_of(report_.results.begin(), report_.results.end(), [&](const Result& result) {
                    return result.code.empty() && result.name == property.name &&
                           (result.verdict == Verdict::undecided ||
                            (marks_.empty() && result.verdict == Verdict::proved));
                });
            if (is_open) open.push_back(property);
        }
        return open;
    }

    void try_ends() {
        const std::uint32_t all_high = (1U << points_.size()) - 1;
        for (std::uint32_t high = 0; high <= all_high; ++high) {
            const bool is_end = high == 0 || high == all_high;
            if (!is_end && points_.size() > kMostCombined) continue;
            const std::vector<verify::Property> open = open_properties();
            if (!is_end && open.empty()) continue;
            Presets values;
            for (std::size_t i = 0; i < points_.size(); ++i)
                values.push_back((high >> i & 1U) != 0 ? points_[i].highest : points_[i].lowest);
            note_broken(verified(values, open, how_), &values);
        }
        if (!marks_.empty()) return;
        for (Result& result : report_.results) {
            if (result.verdict != Verdict::proved) continue;
            result.verdict = Verdict::undecided;
            result.vacuous = false;
            result.only_by_error = false;
            result.reason = fmt::format(
                "it holds at the ends of the ranges; a RANGE of a count that goes to {} is too large to be "
                "decided between them: let it end sooner, as RANGE 1 .. 2000 does, or look at the defaults "
                "alone "
                "with --set-points default",
                kMostPreset);
            report_.complete = false;
        }
    }

    std::size_t count_of_counts() const {
        std::size_t product = 1;
        for (std::size_t i = 0; i < points_.size() && product <= kMostCounts; ++i) {
            if (is_count(i)) product *= static_cast<std::size_t>(points_[i].highest - points_[i].lowest) + 1;
        }
        return product;
    }

    /// The combination of counts with this number; times remain ranges.
    Presets combination(std::size_t number) const {
        Presets values = marks_;
        for (std::size_t i = 0; i < points_.size(); ++i) {
            if (!is_count(i)) continue;
            const auto many = static_cast<std::size_t>(points_[i].highest - points_[i].lowest) + 1;
            values[i] = points_[i].lowest + static_cast<std::int32_t>(number % many);
            number /= many;
        }
        return values;
    }

    /// Single counts can decide more than all counts at once.
    void try_counts() {
        const std::size_t count = count_of_counts();
        std::vector<verify::Property> open = open_properties();
        if (count < 2 || count > kMostCounts || open.empty()) return;
        verify::Options options = ranged(false);
        options.checks = false;
        std::map<std::string, std::size_t> left_open;
        std::map<std::string, Result> proved;
        for (std::size_t number = 0; number < count && !open.empty(); ++number) {
            const Presets values = combination(number);
            const verify::Report tried = verified(values, open, options);
            note_counts(tried, values);
            for (const Result& result : tried.results) {
                const bool is_open = result.verdict == Verdict::undecided;
                if (is_open) ++left_open[result.name];
                if (result.verdict == Verdict::proved) note_proved(proved, result);
                const bool is_over = result.verdict == Verdict::broken || left_open[result.name] >= kMostOpen;
                if (is_over) std::erase_if(open, [&](const auto& p) { return p.name == result.name; });
            }
        }
        for (const verify::Property& property : open) {
            if (left_open[property.name] != 0) continue;
            for (Result& result : report_.results) {
                if (!result.code.empty() || result.name != property.name) continue;
                result = proved[property.name];
            }
        }
    }

    /// A proof says nothing if it does with none of the counts, and is by way of ERROR if it is with one.
    static void note_proved(std::map<std::string, Result>& proved, const Result& result) {
        const auto [known, is_new] = proved.try_emplace(result.name, result);
        const bool says_more = known->second.vacuous && !result.vacuous;
        if (!is_new && !known->second.only_by_error && (says_more || result.only_by_error))
            known->second = result;
    }

    void note_counts(const verify::Report& tried, const Presets& counts) {
        for (const Result& result : tried.results) {
            if (result.verdict != Verdict::broken) continue;
            Presets values = counts;
            for (std::size_t i = 0; i < points_.size(); ++i) {
                if (!is_count(i)) values[i] = defaults_[i];
            }
            for (Result& known : report_.results) {
                if (!is_same(known, result)) continue;
                known = result;
                add_values(known, values_in(result, values));
            }
        }
    }

    verify::Report verified(const Presets& values, const std::vector<verify::Property>& properties,
                            const verify::Options& how) const {
        std::vector<std::uint8_t> bytes = table_;
        for (std::size_t i = 0; i < points_.size(); ++i) {
            for (const std::uint16_t place : points_[i].places) {
                const std::span<std::uint8_t> term = std::span(bytes).subspan(place * sequencer::kTermBytes);
                table::set_value(term.first<sequencer::kTermBytes>(), static_cast<std::uint16_t>(values[i]));
            }
        }
        const auto loaded = sequencer::Table::load(bytes);
        return verify::verify(loaded.table, names_, properties, how);
    }

    static constexpr std::int32_t kMostPreset = 0xFFFF;

    std::vector<std::uint8_t> table_;
    const verify::Names& names_;
    const std::vector<verify::Property>& properties_;
    verify::Options how_;
    std::vector<SetPoint> points_;  ///< of times and counts
    Presets defaults_;
    Presets marks_;
    verify::Report report_;
};

}  // namespace

verify::Report verify_all_values(std::span<const std::uint8_t> table, const set_points::Record& record,
                                 const verify::Names& names, const std::vector<verify::Property>& properties,
                                 const verify::Options& how) {
    return AllValues(table, record, names, properties, how).run();
}

}  // namespace nplc::seqc::cli
