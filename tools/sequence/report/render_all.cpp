#include <fmt/format.h>

#include <algorithm>

#include "host/printable.h"
#include "seqc/seqc.h"

namespace nplc::seqc {

std::string render_all(const Compilation& compilation, std::string_view source, std::string_view file_name,
                       Colour colour) {
    return render_all(compilation, Sources({std::string(file_name), std::string(source)}), colour);
}

std::string render_all(const Compilation& compilation, const Sources& sources, Colour colour) {
    const std::string file_name = host::printable(sources.program().name);
    const std::vector<Diagnostic>& all = compilation.diagnostics;
    if (all.empty()) return {};
    std::string text;
    for (const Diagnostic& diagnostic : all) text += render(diagnostic, sources, colour);
    if (compilation.more_diagnostics) {
        text += fmt::format("{}: there are more; only {} are shown, correct these first\n", file_name,
                            all.size());
    }
    const auto errors = std::count_if(all.begin(), all.end(),
                                      [](const Diagnostic& d) { return d.severity == Severity::error; });
    const auto warnings = std::ssize(all) - errors;
    return text + fmt::format("{}: {} error{}, {} warning{}\n", file_name, errors, errors == 1 ? "" : "s",
                              warnings, warnings == 1 ? "" : "s");
}

}  // namespace nplc::seqc
