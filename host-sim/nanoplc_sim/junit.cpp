#include "junit.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace nplc::sim {
namespace {

/// Bytes of the character that begins here; 0: it is none.
std::size_t length_of_character(std::string_view text) {
    const auto first = static_cast<unsigned char>(text.front());
    if (first < 0x80) return first >= 0x20 && first != 0x7F ? 1 : 0;
    const std::size_t length = first >= 0xF0 && first < 0xF5 ? 4 : first >= 0xE0 ? 3 : first >= 0xC2 ? 2 : 0;
    if (length == 0 || first >= 0xF5 || text.size() < length) return 0;
    const std::string_view rest = text.substr(1, length - 1);
    const auto follows = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; };
    return std::all_of(rest.begin(), rest.end(), follows) ? length : 0;
}

std::string escaped(std::string_view text) {
    std::string result;
    while (!text.empty()) {
        const std::size_t length = length_of_character(text);
        switch (length == 1 ? text.front() : '\0') {
            case '&':
                result += "&amp;";
                break;
            case '<':
                result += "&lt;";
                break;
            case '>':
                result += "&gt;";
                break;
            case '"':
                result += "&quot;";
                break;
            default:
                result += length == 0 ? "?" : text.substr(0, length);
        }
        text.remove_prefix(std::max<std::size_t>(length, 1));
    }
    return result;
}

std::string seconds(Time time) {
    return fmt::format("{:.6f}", static_cast<double>(time.count()) / 1e9);
}

std::string case_of(const Outcome& outcome, const std::string& scenario, const std::string& program) {
    const std::string file = escaped(scenario);
    std::string text =
        fmt::format("    <testcase classname=\"{}\" name=\"{}: {}\" file=\"{}\" line=\"{}\" time=\"{}\"",
                    escaped(program), outcome.line, escaped(outcome.expectation), file, outcome.line,
                    seconds(outcome.decided));
    if (outcome.passed) return text + "/>\n";
    const std::string seen = escaped(outcome.seen);
    return text + fmt::format(
                      ">\n      <failure message=\"{}\" type=\"expectation\">{}:{}: expected: {}; "
                      "seen: {}</failure>\n    </testcase>\n",
                      seen, file, outcome.line, escaped(outcome.expectation), seen);
}

}  // namespace

std::string junit_of(const std::vector<Outcome>& outcomes, const std::string& scenario,
                     const std::string& program, Time end) {
    const auto failures =
        std::count_if(outcomes.begin(), outcomes.end(), [](const Outcome& o) { return !o.passed; });
    const std::string counts =
        fmt::format("tests=\"{}\" failures=\"{}\" errors=\"0\" skipped=\"0\" time=\"{}\"", outcomes.size(),
                    failures, seconds(end));
    std::string text = fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites {}>\n  <testsuite name=\"{}\" {}>\n", counts,
        escaped(scenario), counts);
    for (const Outcome& outcome : outcomes) text += case_of(outcome, scenario, program);
    return text + "  </testsuite>\n</testsuites>\n";
}

}  // namespace nplc::sim
