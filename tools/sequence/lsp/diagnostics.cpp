#include <fmt/format.h>

#include "lsp/features.h"
#include "rehearsal/scenario_text.h"
#include "report/verify_question.h"

namespace nplc::seqc::lsp {
namespace {

constexpr int kError = 1;
constexpr int kWarning = 2;

Json related_json(const Workspace& workspace, const View& view, const std::vector<Note>& notes) {
    Json related = Json::array();
    for (const Note& note : notes)
        related.push_back(
            {{"location", workspace.location_json(view, note.span)}, {"message", note.message}});
    return related;
}

Json diagnostic_json(const Workspace& workspace, const View& view, const Diagnostic& diagnostic) {
    Json json = {
        {"range", workspace.range_json(view, diagnostic.span)},
        {"severity", diagnostic.severity == Severity::error ? kError : kWarning},
        {"code", diagnostic.code},
        {"source", "seqc"},
        {"message", diagnostic.help.empty() ? diagnostic.message
                                            : fmt::format("{}\n{}", diagnostic.message, diagnostic.help)}};
    if (!diagnostic.notes.empty())
        json["relatedInformation"] = related_json(workspace, view, diagnostic.notes);
    if (diagnostic.code == "W005") json["tags"] = {1};  // unnecessary: shown faded
    return json;
}

Json line_diagnostic(const Workspace& workspace, const analysis::Lines& lines, int line, int column,
                     const std::string& message) {
    const auto count = static_cast<int>(lines.count());
    const auto number = static_cast<std::uint32_t>(line < 1 ? 0 : line > count ? count - 1 : line - 1);
    const auto length = static_cast<std::uint32_t>(lines.line(number).size());
    const auto from = static_cast<std::uint32_t>(column > 1 ? column - 1 : 0);
    const Span span = column > 0 && from < length ? Span{lines.start_of(number) + from, length - from}
                                                  : Span{lines.start_of(number), length};
    return {{"range", workspace.range_json(lines, span)},
            {"severity", kError},
            {"source", "seqc"},
            {"message", message}};
}

Json scenario_diagnostics(Workspace& workspace, const Document& document) {
    Json list = Json::array();
    std::string uri;
    const auto program = workspace.companion_of(document, uri);
    if (!program) return list;
    for (const auto& mistake : rehearsal::mistakes_in_scenario(document.text(), path_of_uri(document.uri()),
                                                               program->compiled().symbols))
        list.push_back(
            line_diagnostic(workspace, document.lines(), mistake.line, mistake.column, mistake.message));
    return list;
}

Json property_diagnostics(Workspace& workspace, const Document& document) {
    Json list = Json::array();
    const View view = workspace.view_of(document);
    const Compilation& compiled = view.program->compiled();
    for (const Diagnostic& diagnostic : compiled.diagnostics) {
        if (diagnostic.severity == Severity::error && view.in_property_file(diagnostic.span.offset))
            list.push_back(diagnostic_json(workspace, view, diagnostic));
    }
    return list;
}

/// For an include file that no program includes only the syntax can be checked.
std::vector<Diagnostic> told(const analysis::Program& program, const Document& document) {
    const bool is_alone = program.is_part() && program.sources().has_first() &&
                          &program.sources().program() == &program.own_file();
    return is_alone && document.uri().ends_with(".seqi") ? program.grammar() : program.compiled().diagnostics;
}

}  // namespace

std::map<std::string, Json> diagnostics_of(Workspace& workspace, const Document& document) {
    if (document.language() == Language::scenario)
        return {{document.uri(), scenario_diagnostics(workspace, document)}};
    if (document.language() == Language::property)
        return {{document.uri(), property_diagnostics(workspace, document)}};
    std::map<std::string, Json> lists;
    const View view = workspace.view_of(document);
    const bool is_seen_from_elsewhere = !view.part_uri.empty();
    for (const Diagnostic& diagnostic : told(*view.program, document)) {
        const bool is_own = view.program->is_own(diagnostic.span);
        if (is_seen_from_elsewhere && !is_own) continue;
        lists[is_own ? document.uri() : workspace.uri_at(view, diagnostic.span)].push_back(
            diagnostic_json(workspace, view, diagnostic));
    }
    return lists;
}

}  // namespace nplc::seqc::lsp
