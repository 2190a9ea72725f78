#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// The findings of `why`, and the rules behind them.
namespace nplc::causes {

enum class Severity : std::uint8_t {
    stops,    ///< it cannot move because of this
    hinders,  ///< it may stop soon, or moves less than wanted, or not everywhere
    tells,    ///< information
};

/// For programs.
constexpr std::string_view name_of(Severity severity) {
    constexpr std::string_view kNames[] = {"stops", "hinders", "tells"};
    return kNames[static_cast<std::size_t>(severity)];
}

/// One cause.
struct Finding {
    std::string code;  ///< stable, for programs: "torque_zero"
    Severity severity = Severity::stops;
    std::string sentence{};
    std::vector<std::string_view> sources{};  ///< registers or parameters whose values prove it
    std::string remedy{};
};

/// The motion that following a remedy may cause.
enum class Lets : std::uint8_t {
    nothing,
    turn,  ///< as its mode demands
    jump,  ///< the motor pushes, and the obstacle yields
};

/// A cause as a row of a table. In its texts {KEY} stands for Facts::word(KEY), and a key's `*` for the first
/// source.
template <class Facts>
struct Rule {
    using Condition = bool (*)(const Facts&);

    std::string_view code;
    Severity severity;
    Condition holds;
    std::string_view sentence;
    std::string_view sources;  ///< a blank between them; those that the motor does not have are left out
    std::string_view remedy;
    Lets lets = Lets::nothing;
    Condition only_hinders = nullptr;  ///< instead of stopping it
};

/// `text` with word(KEY) in the place of each {KEY}.
std::string filled(std::string_view text, std::string_view first,
                   const std::function<std::string(std::string_view)>& word);
/// The words between blanks.
std::vector<std::string_view> words_of(std::string_view text);

template <class Facts>
Finding finding_of(const Rule<Facts>& rule, const Facts& facts) {
    const bool hinders = rule.only_hinders != nullptr && rule.only_hinders(facts);
    Finding finding{.code = std::string(rule.code), .severity = hinders ? Severity::hinders : rule.severity};
    const auto sources = words_of(rule.sources);
    const std::string_view first = sources.empty() ? std::string_view() : sources.front();
    const auto word = [&](std::string_view key) { return facts.word(key); };
    finding.sentence = filled(rule.sentence, first, word);
    finding.remedy = filled(rule.remedy, first, word);
    for (const std::string_view source : sources) {
        if (const std::string_view name = facts.name_of(source); !name.empty())
            finding.sources.push_back(name);
    }
    return finding;
}

/// True if nothing found keeps it from moving.
bool only_tell(std::span<const Finding> findings);

}  // namespace nplc::causes
