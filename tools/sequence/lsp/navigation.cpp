#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "editing/names.h"
#include "editing/outline.h"
#include "language/names.h"
#include "lsp/features.h"
#include "lsp/scenario_shape.h"
#include "lsp/scenario_words.h"

namespace nplc::seqc::lsp {
namespace {

using analysis::Kind;
using analysis::Symbol;

int symbol_kind(Kind kind) {
    switch (kind) {
        case Kind::program:
            return 2;  // Module
        case Kind::step:
        case Kind::sequence:
            return 12;  // Function
        case Kind::group:
            return 3;  // Namespace
        case Kind::input:
        case Kind::output:
            return 13;  // Variable
        case Kind::motor_variable:
        case Kind::constant:
        case Kind::parameter:
        case Kind::set_point:
            return 14;  // Constant
        case Kind::property:
            return 7;  // Property
    }
    return 13;
}

/// The file of an INCLUDE, by its text.
std::optional<std::string> file_at(const Workspace& workspace, const analysis::Program& program,
                                   std::uint32_t text_offset) {
    const Sources& sources = program.sources();
    const Sources::Inclusion* inclusion = sources.inclusion_at(text_offset);
    if (inclusion == nullptr || !inclusion->meant) return std::nullopt;
    return workspace.uri_of_file(sources.files()[*inclusion->meant]);
}

Json document_links(Workspace& workspace, const Json& params) {
    const At at(workspace, params);
    Json links = Json::array();
    if (at.document.language() != Language::program) return links;
    for (const Span span : at.program().tree().includes) {
        if (!at.program().is_own(span)) continue;
        if (const auto uri = file_at(workspace, at.program(), span.offset))
            links.push_back({{"range", workspace.range_json(at.view, span)}, {"target", *uri}});
    }
    return links;
}

Json definition(Workspace& workspace, const Json& params) {
    const At at(workspace, params);
    if (at.document.language() == Language::scenario) return scenario_definition(workspace, at);
    for (const Span include : at.program().tree().includes) {
        if (!analysis::holds(include, at.offset)) continue;
        const auto uri = file_at(workspace, at.program(), include.offset);
        return uri ? Json{{"uri", *uri}, {"range", workspace.range_json(analysis::Lines(""), {})}} : Json();
    }
    const auto span = analysis::definition_at(at.program(), at.offset);
    return span ? workspace.location_json(at.view, *span) : Json();
}

Json references(Workspace& workspace, const Json& params) {
    const At at(workspace, params);
    if (at.document.language() == Language::scenario) return scenario_references(workspace, at);
    const bool with_declaration = params.value("/context/includeDeclaration"_json_pointer, true);
    const auto declared = analysis::definition_at(at.program(), at.offset);
    Json found = Json::array();
    for (const analysis::Occurrence& occurrence : analysis::occurrences_at(at.program(), at.offset)) {
        if (with_declaration || !declared || !(occurrence.span == *declared))
            found.push_back(workspace.location_json(at.view, occurrence.span));
    }
    if (const auto name = analysis::renamable_at(at.program(), at.offset)) {
        const Kind kind = at.program().definition_of(*at.program().reference_at(at.offset))->kind;
        add_scenario_locations(workspace, at.view.uri, at.program().text(*name), kind, found);
    }
    return found;
}

Json highlights(Workspace& workspace, const Json& params) {
    const At at(workspace, params);
    if (at.document.language() == Language::scenario) return scenario_highlights(workspace, at);
    Json found = Json::array();
    for (const analysis::Occurrence& occurrence : analysis::occurrences_at(at.program(), at.offset)) {
        const bool is_here = at.view.property_uri.empty() ? at.program().is_own(occurrence.span)
                                                          : at.view.in_property_file(occurrence.span.offset);
        if (is_here)
            found.push_back({{"range", workspace.range_json(at.view, occurrence.span)},
                             {"kind", occurrence.writes ? 3 : 2}});
    }
    return found;
}

Json prepare_rename(Workspace& workspace, const Json& params) {
    const At at(workspace, params);
    if (at.document.language() == Language::scenario) return scenario_prepare_rename(workspace, at);
    const auto span = analysis::renamable_at(at.program(), at.offset);
    if (!span) return Json();
    return {{"range", workspace.range_json(at.view, *span)}, {"placeholder", at.program().text(*span)}};
}

/// For a name of an included file: adds its occurrences in other programs that include the file.
void add_programs_beside(Workspace& workspace, const At& at, Span name, const std::string& new_name,
                         Json& found) {
    const SourceFile& file = at.program().sources().file_at(name.offset);
    if (&file == &at.program().sources().program()) return;
    for (const auto& [uri, program] : workspace.programs_that_include(file)) {
        if (uri == at.view.uri) continue;
        const auto& files = program->sources().files();
        const auto there = std::find_if(files.begin(), files.end(), [&](const SourceFile& other) {
            return other.identity == file.identity;
        });
        const std::uint32_t offset = there->offset + (name.offset - file.offset);
        const analysis::Renaming renaming = analysis::rename(*program, offset, new_name);
        if (!renaming.error.empty())
            throw ResponseError(kRequestFailed, fmt::format("{}: {}", uri, renaming.error));
        const View view{program, uri, {}, {}, 0, 0};
        for (const analysis::TextEdit& edit : renaming.edits)
            found.push_back(workspace.location_json(view, edit.span));
        add_scenario_locations(workspace, uri, renaming.old_name,
                               program->definition_of(*program->reference_at(offset))->kind, found);
    }
}

Json rename(Workspace& workspace, const Json& params) {
    At at(workspace, params);
    const std::string new_name = params.value("newName", "");
    if (at.document.language() == Language::scenario) {
        const analysis::Definition* definition = scenario_name_at(at);
        if (definition == nullptr)
            throw ResponseError(kRequestFailed, "there is no name of the program here");
        at.offset = definition->name_span.offset;
    }
    const analysis::Renaming renaming = analysis::rename(at.program(), at.offset, new_name);
    if (!renaming.error.empty()) throw ResponseError(kRequestFailed, renaming.error);
    const Kind kind = at.program().definition_of(*at.program().reference_at(at.offset))->kind;
    if (kind == Kind::set_point && is_value_of_scenarios(new_name))
        throw ResponseError(kRequestFailed, fmt::format("'{}' means something else in scenarios", new_name));
    Json changes = Json::object();
    const auto add = [&](const Json& location) {
        Json& list = changes[location["uri"].get<std::string>()];
        const Json change = {{"range", location["range"]}, {"newText", new_name}};
        if (std::find(list.begin(), list.end(), change) == list.end()) list.push_back(change);
    };
    for (const analysis::TextEdit& edit : renaming.edits) add(workspace.location_json(at.view, edit.span));
    const analysis::Definition& definition =
        *at.program().definition_of(*at.program().reference_at(at.offset));
    Json others = Json::array();
    add_scenario_locations(workspace, at.view.uri, renaming.old_name, definition.kind, others);
    add_programs_beside(workspace, at, definition.name_span, new_name, others);
    for (const Json& location : others) {
        if (location["uri"].get<std::string>() != at.view.property_uri) add(location);
    }
    return {{"changes", changes}};
}

Json symbol_json(const Workspace& workspace, const View& view, const Symbol& symbol) {
    Json json = {{"name", symbol.name},
                 {"detail", symbol.detail},
                 {"kind", symbol_kind(symbol.kind)},
                 {"range", workspace.range_json(view, symbol.whole)},
                 {"selectionRange", workspace.range_json(view, symbol.selection)}};
    if (!symbol.children.empty()) json["children"] = Json::array();
    for (const Symbol& child : symbol.children)
        json["children"].push_back(symbol_json(workspace, view, child));
    return json;
}

Json document_symbols(Workspace& workspace, const Json& params) {
    const At at(workspace, params);
    if (at.document.language() == Language::scenario) return scenario_symbols(workspace, at);
    Json list = Json::array();
    for (const Symbol& symbol : analysis::symbols_of(at.program())) {
        if (at.view.property_uri.empty()) {
            list.push_back(symbol_json(workspace, at.view, symbol));
            continue;
        }
        for (const Symbol& child : symbol.children) {
            if (at.view.in_property_file(child.selection.offset))
                list.push_back(symbol_json(workspace, at.view, child));
        }
    }
    return list;
}

Json workspace_symbols(Workspace& workspace, const Json& params) {
    constexpr std::size_t kMost = 500;
    const std::string query = upper(params.value("query", ""));
    Json list = Json::array();
    for (const auto& [uri, program] : workspace.programs()) {
        for (const analysis::Definition& definition : program->definitions()) {
            if (!program->is_own(definition.name_span)) continue;
            if (list.size() >= kMost || upper(definition.name).find(query) == std::string::npos) continue;
            list.push_back(
                {{"name", definition.name},
                 {"kind", symbol_kind(definition.kind)},
                 {"containerName", program->symbols().program},
                 {"location",
                  {{"uri", uri}, {"range", workspace.range_json(program->lines(), definition.name_span)}}}});
        }
    }
    return list;
}

}  // namespace

void add_navigation(Handlers& handlers) {
    handlers["textDocument/definition"] = definition;
    handlers["textDocument/declaration"] = definition;
    handlers["textDocument/documentLink"] = document_links;
    handlers["textDocument/references"] = references;
    handlers["textDocument/documentHighlight"] = highlights;
    handlers["textDocument/prepareRename"] = prepare_rename;
    handlers["textDocument/rename"] = rename;
    handlers["textDocument/documentSymbol"] = document_symbols;
    handlers["workspace/symbol"] = workspace_symbols;
}

}  // namespace nplc::seqc::lsp
