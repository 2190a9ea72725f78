#include "compiler/numbers_taken.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <map>
#include <string>
#include <utility>

namespace nplc::seqc {
namespace {

using Offsets = std::vector<std::uint32_t>;

/// A SEQUENCE and the numbers that its steps take.
struct Taken {
    ast::Name sequence;
    std::map<Offsets, std::pair<std::vector<Span>, std::size_t>> in_calls;  ///< by calls that share steps
    std::size_t sum = 0;

    void add(const ast::Origin& origin, std::size_t numbers) {
        Offsets offsets;
        for (const Span call : origin.calls) offsets.push_back(call.offset);
        auto& [calls, count] = in_calls[offsets];
        calls = origin.calls;
        count += numbers;
        sum += numbers;
    }
};

/// "4 in each of the calls on lines 12 and 20, 2 in the call on line 30"
std::string shares(const Taken& taken, const SequenceCalls& calls) {
    std::map<std::size_t, std::vector<Span>, std::greater<>> equal;
    std::vector<std::string> parts;
    for (const auto& [offsets, in_call] : taken.in_calls) {
        const auto& [places, count] = in_call;
        if (places.size() == 1)
            equal[count].push_back(places.front());
        else
            parts.push_back(fmt::format("{} shared {}", count, calls.lines(places)));
    }
    std::vector<std::string> single;
    for (const auto& [count, places] : equal)
        single.push_back(
            fmt::format("{} {}{}", count, places.size() > 1 ? "each " : "", calls.lines(places)));
    single.insert(single.end(), parts.begin(), parts.end());
    return fmt::format("{}", fmt::join(single, ", "));
}

}  // namespace

void note_numbers_taken(const std::vector<CopyKey>& copies, const Plan& plan, const SequenceCalls& calls,
                        Diagnostic& diagnostic) {
    constexpr std::size_t kMostNoted = 3;
    std::vector<std::size_t> numbers(plan.steps.size());
    for (const CopyKey& copy : copies) ++numbers[copy.step];
    std::vector<Taken> sequences;
    std::vector<std::size_t> others;
    for (std::size_t i = 0; i < plan.steps.size(); ++i) {
        const ast::Origin* origin = calls.origin_of(plan.steps[i].name);
        if (origin == nullptr) {
            if (numbers[i] > 1) others.push_back(i);
            continue;
        }
        auto taken = std::find_if(sequences.begin(), sequences.end(), [&](const Taken& known) {
            return known.sequence.span == origin->sequence.span;
        });
        if (taken == sequences.end()) taken = sequences.insert(taken, {origin->sequence, {}, 0});
        taken->add(*origin, numbers[i]);
    }
    for (const Taken& taken : sequences)
        diagnostic.notes.push_back(
            {taken.sequence.span, fmt::format("SEQUENCE '{}' takes {} of the numbers: {}",
                                              taken.sequence.text, taken.sum, shares(taken, calls))});
    std::stable_sort(others.begin(), others.end(),
                     [&](std::size_t a, std::size_t b) { return numbers[a] > numbers[b]; });
    if (others.size() > kMostNoted) others.resize(kMostNoted);
    for (const std::size_t i : others) {
        const Span place = plan.steps[i].span;
        const auto told = std::find_if(diagnostic.notes.begin(), diagnostic.notes.end(),
                                       [&](const Note& note) { return note.span == place; });
        if (told != diagnostic.notes.end()) {
            told->message += fmt::format(", and takes {} of the numbers", numbers[i]);
        } else {
            diagnostic.notes.push_back(
                {place, fmt::format("'{}' takes {} of the numbers, one for each case that it has to remember",
                                    plan.steps[i].name, numbers[i])});
        }
    }
}

}  // namespace nplc::seqc
