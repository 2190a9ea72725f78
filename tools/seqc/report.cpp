#include "report.h"

#include <algorithm>
#include <utility>

namespace nplc::seqc {

Diagnostic& Report::add(Diagnostic diagnostic) {
    if (diagnostic.severity == Severity::error) ++errors_;
    if (full()) return dropped_ = std::move(diagnostic);
    return diagnostics_.emplace_back(std::move(diagnostic));
}

Diagnostic& Report::error(const char* code, Span span, std::string message, std::string help) {
    return add({Severity::error, code, std::move(message), std::move(help), span, {}});
}

Diagnostic& Report::warning(const char* code, Span span, std::string message, std::string help) {
    return add({Severity::warning, code, std::move(message), std::move(help), span, {}});
}

std::vector<Diagnostic> Report::take() {
    std::stable_sort(diagnostics_.begin(), diagnostics_.end(),
                     [](const Diagnostic& a, const Diagnostic& b) { return a.span.offset < b.span.offset; });
    return std::move(diagnostics_);
}

}  // namespace nplc::seqc
