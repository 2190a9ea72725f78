#include "cli/json.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli/common.h"

namespace nplc::seqc::cli {
namespace {

using Json = nlohmann::ordered_json;

void add_place(Json& object, const Positions& positions, Span span) {
    const Position first = positions.of(span.offset);
    const Position end = positions.of(span.offset + span.length);
    object["line"] = first.line;
    object["column"] = first.column;
    object["end_line"] = end.line;
    object["end_column"] = end.column;
}

Json diagnostic_object(const Diagnostic& diagnostic, const Positions& positions,
                       const std::string& file_name) {
    Json object;
    object["severity"] = diagnostic.severity == Severity::error ? "error" : "warning";
    object["code"] = diagnostic.code;
    object["message"] = diagnostic.message;
    object["help"] = diagnostic.help;
    object["file"] = file_name;
    add_place(object, positions, diagnostic.span);
    object["notes"] = Json::array();
    for (const Note& note : diagnostic.notes) {
        Json& added = object["notes"].emplace_back();
        added["message"] = note.message;
        added["file"] = file_name;
        add_place(added, positions, note.span);
    }
    return object;
}

}  // namespace

int print_json(const Json& document, int exit_code) {
    const int printed =
        print_or_write(document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n", {});
    return printed == kOk ? exit_code : printed;
}

Json diagnostics_document(const Compilation& compilation, std::string_view source,
                          const std::string& file_name) {
    const auto errors = std::count_if(compilation.diagnostics.begin(), compilation.diagnostics.end(),
                                      [](const Diagnostic& d) { return d.severity == Severity::error; });
    const Positions positions(source);
    Json document;
    document["file"] = file_name;
    document["ok"] = compilation.ok;
    document["errors"] = errors;
    document["warnings"] = std::ssize(compilation.diagnostics) - errors;
    document["more"] = compilation.more_diagnostics;
    document["diagnostics"] = Json::array();
    for (const Diagnostic& diagnostic : compilation.diagnostics)
        document["diagnostics"].push_back(diagnostic_object(diagnostic, positions, file_name));
    return document;
}

Json problem_document(const std::string& file_name, const std::string& problem) {
    Json document = diagnostics_document({}, {}, file_name);
    document["error"] = problem;
    return document;
}

}  // namespace nplc::seqc::cli
