#include "junit.h"

#include <fmt/format.h>

#include <string_view>

#include "sim/text.h"

namespace nplc::sim {
namespace {

std::string seconds(Time time) {
    return fmt::format("{:.6f}", static_cast<double>(time.count()) / 1e9);
}

std::string case_of(const ExpectationResult& outcome, const std::string& scenario,
                    const std::string& program) {
    const std::string file = in_xml(scenario);
    std::string text = fmt::format(
        "    <testcase classname=\"{}\" name=\"{}: {}\" file=\"{}\" line=\"{}\" time=\"{}\"", in_xml(program),
        outcome.line, in_xml(outcome.expectation), file, outcome.line, seconds(outcome.decided));
    if (outcome.passed) return text + "/>\n";
    const std::string seen = in_xml(outcome.seen);
    return text + fmt::format(
                      ">\n      <failure message=\"{}\" type=\"expectation\">{}:{}: expected: {}; "
                      "seen: {}</failure>\n    </testcase>\n",
                      seen, file, outcome.line, in_xml(outcome.expectation), seen);
}

}  // namespace

std::string junit_of(const std::vector<ExpectationResult>& outcomes, const std::string& scenario,
                     const std::string& program, Time end) {
    const auto failures =
        std::count_if(outcomes.begin(), outcomes.end(), [](const ExpectationResult& o) { return !o.passed; });
    const std::string counts =
        fmt::format("tests=\"{}\" failures=\"{}\" errors=\"0\" skipped=\"0\" time=\"{}\"", outcomes.size(),
                    failures, seconds(end));
    std::string text = fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites {}>\n  <testsuite name=\"{}\" {}>\n", counts,
        in_xml(scenario), counts);
    for (const ExpectationResult& outcome : outcomes) text += case_of(outcome, scenario, program);
    return text + "  </testsuite>\n</testsuites>\n";
}

}  // namespace nplc::sim
