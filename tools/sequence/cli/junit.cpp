#include "cli/junit.h"

#include <fmt/format.h>

#include <algorithm>

#include "analysis/story.h"

namespace nplc::seqc::cli {
namespace {

using verify::Verdict;

std::string escaped(std::string_view text) {
    std::string result;
    for (const char c : text) {
        if (c == '&') {
            result += "&amp;";
        } else if (c == '<') {
            result += "&lt;";
        } else if (c == '"') {
            result += "&quot;";
        } else {
            result += static_cast<unsigned char>(c) < ' ' && c != '\n' ? '?' : c;
        }
    }
    return result;
}

bool counts(const verify::Result& result, Verdict verdict) {
    return result.verdict == verdict && result.severity == verify::Severity::fault;
}

std::string case_of(const verify::Result& result, const std::string& file, const verify::Names& names) {
    std::string text = fmt::format("    <testcase classname=\"{}\" name=\"{}{}: {}\" file=\"{}\"",
                                   escaped(file), result.code.empty() ? "" : result.code + " ",
                                   escaped(result.name), escaped(result.text), escaped(file));
    if (result.verdict == Verdict::proved && result.reason.empty()) return text + "/>\n";
    const bool fails = counts(result, Verdict::broken);
    const char* element = fails ? "failure" : counts(result, Verdict::undecided) ? "error" : "system-out";
    const std::string story = result.course ? verify::story_of(result, names) : "";
    text += fmt::format(">\n      <{}", element);
    if (element != std::string_view("system-out"))
        text += fmt::format(" message=\"{}\" type=\"{}\"", escaped(result.reason),
                            fails ? "broken" : "undecided");
    return text +
           fmt::format(">{}\n{}</{}>\n    </testcase>\n", escaped(result.reason), escaped(story), element);
}

}  // namespace

std::string junit_of(const verify::Report& report, const std::string& file, const verify::Names& names) {
    const auto number_of = [&](Verdict verdict) {
        return std::count_if(report.results.begin(), report.results.end(),
                             [&](const verify::Result& result) { return counts(result, verdict); });
    };
    const std::string numbers =
        fmt::format("tests=\"{}\" failures=\"{}\" errors=\"{}\" skipped=\"0\"", report.results.size(),
                    number_of(Verdict::broken), number_of(Verdict::undecided));
    std::string text = fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites {}>\n  <testsuite name=\"{}\" {}>\n",
        numbers, escaped(file), numbers);
    for (const verify::Result& result : report.results) text += case_of(result, file, names);
    return text + "  </testsuite>\n</testsuites>\n";
}

}  // namespace nplc::seqc::cli
