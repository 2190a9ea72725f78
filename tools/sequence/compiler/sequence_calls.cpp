#include "compiler/sequence_calls.h"

#include <fmt/format.h>

#include <algorithm>

#include "language/names.h"

namespace nplc::seqc {

const ast::Origin* SequenceCalls::origin_of(std::string_view step) const {
    const auto found = std::find_if(
        program_.steps.begin(), program_.steps.end(),
        [&](const ast::Step& known) { return known.origin && same_name(known.name.text, step); });
    return found == program_.steps.end() ? nullptr : &*found->origin;
}

std::string SequenceCalls::shown(std::string_view step) const {
    const ast::Origin* origin = origin_of(step);
    return origin == nullptr ? fmt::format("'{}'", step)
                             : fmt::format("'{}' of SEQUENCE {}", origin->step, origin->sequence.text);
}

std::string SequenceCalls::lines(std::vector<Span> calls) const {
    constexpr std::size_t kMost = 12;
    std::sort(calls.begin(), calls.end(), [](Span a, Span b) { return a.offset < b.offset; });
    const Places places(sources_);
    std::vector<std::string> lines;
    for (const Span call : calls) {
        std::string line = places.line_text(call.offset);
        if (lines.empty() || lines.back() != line) lines.push_back(std::move(line));
    }
    if (lines.size() == 1) return fmt::format("in the call on line {}", lines.front());
    if (lines.size() > kMost + 1) {
        const std::size_t more = lines.size() - kMost;
        lines.resize(kMost);
        lines.push_back(fmt::format("{} more", more));
    }
    const std::string last = std::move(lines.back());
    lines.pop_back();
    return fmt::format("in the calls on lines {} and {}", fmt::join(lines, ", "), last);
}

}  // namespace nplc::seqc
