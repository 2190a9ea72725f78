#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace nplc::macreg {

/// Of what `why` has found.
enum class Severity : std::uint8_t {
    stops,    ///< it cannot move because of it
    hinders,  ///< it may soon, moves less than wanted, or not everywhere
    tells,    ///< good to know
};

/// For programs.
constexpr std::string_view name_of(Severity severity) {
    constexpr std::string_view kNames[] = {"stops", "hinders", "tells"};
    return kNames[static_cast<std::size_t>(severity)];
}

/// One cause. `Source` is how the motor's values are called: registers by number, parameters by name.
template <class Source>
struct BasicFinding {
    std::string code;  ///< stable, for programs: "torque_zero"
    Severity severity = Severity::stops;
    std::string sentence{};
    std::vector<Source> sources{};  ///< whose values make it so
    std::string remedy{};
};

/// As they are found.
template <class Source>
struct BasicFindings {
    std::vector<BasicFinding<Source>> all{};

    void add(Severity severity, std::string code, std::string sentence, std::vector<Source> sources,
             std::string remedy) {
        all.push_back(
            {std::move(code), severity, std::move(sentence), std::move(sources), std::move(remedy)});
    }
    void stops(std::string code, std::string sentence, std::vector<Source> sources, std::string remedy) {
        add(Severity::stops, std::move(code), std::move(sentence), std::move(sources), std::move(remedy));
    }
    void hinders(std::string code, std::string sentence, std::vector<Source> sources, std::string remedy) {
        add(Severity::hinders, std::move(code), std::move(sentence), std::move(sources), std::move(remedy));
    }
    void tells(std::string code, std::string sentence, std::vector<Source> sources, std::string remedy) {
        add(Severity::tells, std::move(code), std::move(sentence), std::move(sources), std::move(remedy));
    }
};

}  // namespace nplc::macreg
