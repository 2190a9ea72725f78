#include "diagnostics/report.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace nplc::seqc {

Diagnostic& Report::add(Diagnostic diagnostic) {
    if (diagnostic.severity == Severity::error) ++errors_;
    const auto same = std::find_if(diagnostics_.begin(), diagnostics_.end(), [&](const Diagnostic& d) {
        return d.code == diagnostic.code && d.span == diagnostic.span && d.message == diagnostic.message;
    });
    if (same != diagnostics_.end() && diagnostic.span.length != 0) return dropped_ = std::move(diagnostic);
    if (full()) {
        more_ = true;
        const auto last_warning =
            std::find_if(diagnostics_.rbegin(), diagnostics_.rend(),
                         [](const Diagnostic& d) { return d.severity == Severity::warning; });
        if (diagnostic.severity == Severity::warning || last_warning == diagnostics_.rend())
            return dropped_ = std::move(diagnostic);
        diagnostics_.erase(std::next(last_warning).base());
    }
    return diagnostics_.emplace_back(std::move(diagnostic));
}

Diagnostic& Report::add(Code code, Span span, std::string message, std::string help) {
    const CodeRow& row = code.row();
    return add({row.severity, std::string(row.code), std::move(message), std::move(help), span, {}});
}

bool Report::has(std::string_view code) const {
    return std::any_of(diagnostics_.begin(), diagnostics_.end(),
                       [&](const Diagnostic& d) { return d.code == code; });
}

bool Report::has(std::string_view code, Span span) const {
    return std::any_of(diagnostics_.begin(), diagnostics_.end(),
                       [&](const Diagnostic& d) { return d.code == code && d.span == span; });
}

std::vector<Diagnostic> Report::take() {
    std::stable_sort(diagnostics_.begin(), diagnostics_.end(),
                     [](const Diagnostic& a, const Diagnostic& b) { return a.span.offset < b.span.offset; });
    return std::move(diagnostics_);
}

}  // namespace nplc::seqc
