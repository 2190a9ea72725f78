#include "cli/json.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli/common.h"

namespace nplc::seqc::cli {
namespace {

using Json = nlohmann::ordered_json;

void add_place(Json& object, const Places& places, Span span) {
    const ShownPlace place = places.of(span.offset);
    const Position first = place.at;
    const Position end = places.of(span.offset + span.length).at;
    object["file"] = place.file->name;
    object["line"] = first.line;
    object["column"] = first.column;
    object["end_line"] = end.line;
    object["end_column"] = end.column;
}

Json diagnostic_object(const Diagnostic& diagnostic, const Places& places) {
    Json object;
    object["severity"] = diagnostic.severity == Severity::error ? "error" : "warning";
    object["code"] = diagnostic.code;
    object["message"] = diagnostic.message;
    object["help"] = diagnostic.help;
    add_place(object, places, diagnostic.span);
    object["notes"] = Json::array();
    for (const Note& note : diagnostic.notes) {
        Json& added = object["notes"].emplace_back();
        added["message"] = note.message;
        add_place(added, places, note.span);
    }
    return object;
}

}  // namespace

int print_json(const Json& document, int exit_code) {
    const int printed =
        print_or_write(document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n", {});
    return printed == kOk ? exit_code : printed;
}

Json diagnostics_document(const Compilation& compilation, const Sources& sources) {
    const auto errors = std::count_if(compilation.diagnostics.begin(), compilation.diagnostics.end(),
                                      [](const Diagnostic& d) { return d.severity == Severity::error; });
    const Places places(sources);
    Json document;
    document["file"] = sources.program().name;
    document["ok"] = compilation.ok;
    document["errors"] = errors;
    document["warnings"] = std::ssize(compilation.diagnostics) - errors;
    document["more"] = compilation.more_diagnostics;
    document["diagnostics"] = Json::array();
    for (const Diagnostic& diagnostic : compilation.diagnostics)
        document["diagnostics"].push_back(diagnostic_object(diagnostic, places));
    return document;
}

Json problem_document(const std::string& file_name, const std::string& problem) {
    Json document = diagnostics_document({}, Sources({file_name, {}}));
    document["error"] = problem;
    return document;
}

}  // namespace nplc::seqc::cli
