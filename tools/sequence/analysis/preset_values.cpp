#include "preset_values.h"

#include <algorithm>
#include <optional>

#include "table/terms.h"

namespace nplc::verify {
namespace {

/// Beyond it only all lowest and all highest times.
constexpr std::size_t kMostRanges = 3;

bool add(std::vector<ChosenPreset>& all, const ChosenPreset& one) {
    for (const ChosenPreset& known : all) {
        if (known.preset == one.preset) return known.chosen == one.chosen;
    }
    all.push_back(one);
    return true;
}

/// The counts at which ranges were divided; nothing if those of one range differ.
std::optional<std::vector<ChosenPreset>> counts_in(const Machine& machine,
                                                   std::span<const CourseScan> scans) {
    std::vector<ChosenPreset> counts;
    std::vector<PresetRange> met;
    for (const CourseScan& scan : scans) {
        const table::Outcome& outcome = scan.group->outcome;
        const std::uint16_t counter = outcome.sets_counter() ? outcome.counter_preset : scan.place.counter;
        const PresetRange* const range = machine.counts_of(counter);
        if (range == nullptr) continue;
        met.push_back(*range);
        if (scan.counter != counter && !add(counts, {counter, scan.counter})) return std::nullopt;
    }
    for (const PresetRange& range : met) {
        const bool is_free = std::none_of(counts.begin(), counts.end(), [&](const ChosenPreset& known) {
            return known.preset == range.value;
        });
        if (is_free) counts.push_back({range.value, range.least});
    }
    return counts;
}

std::vector<PresetRange> times_in(const Machine& machine, std::span<const CourseScan> scans) {
    std::vector<PresetRange> times;
    for (const PresetRange& range : machine.ranges().timer) {
        const bool is_met = std::any_of(scans.begin(), scans.end(), [&](const CourseScan& scan) {
            return scan.group->outcome.timer == range.value;
        });
        if (is_met) times.push_back(range);
    }
    return times;
}

}  // namespace

std::vector<std::vector<ChosenPreset>> choices_for(const Machine& machine,
                                                   std::span<const CourseScan> scans) {
    const auto counts = counts_in(machine, scans);
    if (!counts) return {};
    const std::vector<PresetRange> times = times_in(machine, scans);
    const std::uint32_t all_high = (1U << times.size()) - 1;
    std::vector<std::vector<ChosenPreset>> choices;
    for (std::uint32_t high = 0; high <= all_high; ++high) {
        if (times.size() > kMostRanges && high != 0 && high != all_high) continue;
        choices.push_back(*counts);
        for (std::size_t i = 0; i < times.size(); ++i)
            choices.back().push_back(
                {times[i].value, (high >> i & 1U) != 0 ? times[i].most : times[i].least});
    }
    return choices;
}

std::uint16_t chosen_value(std::span<const ChosenPreset> chosen, std::uint16_t preset) {
    for (const ChosenPreset& one : chosen) {
        if (one.preset == preset) return one.chosen;
    }
    return preset;
}

std::vector<std::uint8_t> bytes_with(const sequencer::Table& table, std::span<const ChosenPreset> chosen) {
    std::vector<std::uint8_t> bytes;
    for (std::size_t i = 0; i < table.size(); ++i) {
        const sequencer::TermView term = table.term(i);
        bytes.insert(bytes.end(), term.begin(), term.end());
        if (sequencer::is_flex(term)) continue;
        table::set_value(std::span(bytes).last<sequencer::kTermBytes>(),
                         chosen_value(chosen, static_cast<std::uint16_t>(table::value_of(term))));
    }
    bytes.push_back(sequencer::kEndOfTable);
    bytes.resize(bytes.size() + sequencer::kTermBytes - 1);
    return bytes;
}

}  // namespace nplc::verify
