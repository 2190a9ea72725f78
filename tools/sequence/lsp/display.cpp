#include <fmt/format.h>

#include <algorithm>

#include "editing/hover.h"
#include "editing/outline.h"
#include "lsp/features.h"
#include "lsp/scenario_shape.h"
#include "lsp/scenario_words.h"

namespace nplc::seqc::lsp {
namespace {

Json hover(Workspace& workspace, const Json& params) {
    const At at(workspace, params);
    if (at.document.language() == Language::scenario) return scenario_hover(workspace, at);
    const auto found = analysis::hover_at(at.program(), at.offset);
    if (!found) return Json();
    return {{"contents", {{"kind", "markdown"}, {"value", found->markdown}}},
            {"range", workspace.range_json(at.view, found->span)}};
}

struct Cell {
    analysis::Place place;
    std::uint32_t length = 0;
    std::uint32_t type = 0;
    std::uint32_t modifiers = 0;
};

/// A multi-line token is split into one per line.
void add_cells(const Workspace& workspace, const analysis::Lines& lines, std::string_view text, Span span,
               std::uint32_t type, std::uint32_t modifiers, std::vector<Cell>& cells) {
    const std::uint32_t last = lines.line_of(analysis::end_of(span));
    for (std::uint32_t line = lines.line_of(span.offset); line <= last; ++line) {
        const std::uint32_t begin = std::max(span.offset, lines.start_of(line));
        const auto line_end = static_cast<std::uint32_t>(lines.start_of(line) + lines.line(line).size());
        const std::uint32_t end = std::min(analysis::end_of(span), line_end);
        if (end <= begin) continue;
        cells.push_back({lines.place_of(begin, workspace.encoding),
                         analysis::characters_in(text.substr(begin, end - begin), workspace.encoding), type,
                         modifiers});
    }
}

Json encoded(const std::vector<Cell>& cells) {
    Json data = Json::array();
    analysis::Place before;
    for (const Cell& cell : cells) {
        const std::uint32_t down = cell.place.line - before.line;
        data.push_back(down);
        data.push_back(down == 0 ? cell.place.character - before.character : cell.place.character);
        data.push_back(cell.length);
        data.push_back(cell.type);
        data.push_back(cell.modifiers);
        before = cell.place;
    }
    return {{"data", data}};
}

Json tokens_in(Workspace& workspace, const Json& params, bool whole) {
    const At at(workspace, params);
    const Span range = whole ? Span{0, static_cast<std::uint32_t>(at.document.text().size())}
                             : workspace.span_in(at.document, params.value("range", Json()));
    std::vector<Cell> cells;
    const auto& lines = at.document.lines();
    const auto add = [&](Span span, analysis::TokenType type, std::uint32_t modifiers) {
        if (analysis::end_of(span) >= range.offset && span.offset <= analysis::end_of(range))
            add_cells(workspace, lines, at.document.text(), span, static_cast<std::uint32_t>(type), modifiers,
                      cells);
    };
    if (at.document.language() == Language::scenario) {
        for (const analysis::Coloured& word : scenario_colours(at)) add(word.span, word.type, 0);
        return encoded(cells);
    }
    for (const analysis::Coloured& word : analysis::colours_of(at.program())) {
        Span span = word.span;
        if (!at.view.property_uri.empty()) {
            if (!at.view.in_property_file(span.offset)) continue;
            span.offset -= at.view.inserted_at;
        }
        add(span, word.type, (word.declares ? 1U : 0U) | (word.read_only ? 2U : 0U));
    }
    return encoded(cells);
}

Json tokens_full(Workspace& workspace, const Json& params) {
    return tokens_in(workspace, params, true);
}
Json tokens_range(Workspace& workspace, const Json& params) {
    return tokens_in(workspace, params, false);
}

Json place_json(const Workspace& workspace, const analysis::Lines& lines, std::uint32_t offset) {
    const analysis::Place place = lines.place_of(offset, workspace.encoding);
    return {{"line", place.line}, {"character", place.character}};
}

Json inlay_hints(Workspace& workspace, const Json& params) {
    const At at(workspace, params);
    Json list = Json::array();
    if (at.document.language() != Language::program) return list;
    const Span range = workspace.span_in(at.document, params.value("range", Json()));
    for (const analysis::Hint& hint : analysis::hints_in(at.program(), range)) {
        list.push_back({{"position", place_json(workspace, at.document.lines(), hint.offset)},
                        {"label", hint.text},
                        {"tooltip", hint.tooltip},
                        {"paddingLeft", true}});
    }
    return list;
}

Json fold_json(std::uint32_t first_line, std::uint32_t last_line, bool is_comment) {
    return {{"startLine", first_line}, {"endLine", last_line}, {"kind", is_comment ? "comment" : "region"}};
}

/// Comments of several lines, and properties of several lines.
Json property_folds(Workspace& workspace, const At& at) {
    Json list = text_folds(at.document.lines());
    for (const analysis::Definition& definition : at.program().definitions()) {
        if (definition.kind != analysis::Kind::property || !at.view.in_property_file(definition.whole.offset))
            continue;
        const Json range = workspace.range_json(at.view, definition.whole);
        if (range["start"]["line"] != range["end"]["line"])
            list.push_back(fold_json(range["start"]["line"], range["end"]["line"], false));
    }
    return list;
}

Json folding(Workspace& workspace, const Json& params) {
    const At at(workspace, params);
    if (at.document.language() == Language::scenario) return text_folds(at.document.lines());
    if (at.document.language() == Language::property) return property_folds(workspace, at);
    Json list = Json::array();
    for (const analysis::Fold& fold : analysis::folds_of(at.program()))
        list.push_back(fold_json(fold.first_line, fold.last_line, fold.is_comment));
    return list;
}

/// From the word to the whole text, as places of the document.
std::vector<Span> selections_at(const At& at, std::uint32_t offset) {
    if (at.document.language() == Language::scenario) return scenario_selections(at, offset);
    std::vector<Span> spans = analysis::selections_at(at.program(), offset);
    if (at.view.property_uri.empty()) return spans;
    std::erase_if(spans, [&](Span span) {
        return !at.view.in_property_file(span.offset) || !at.view.in_property_file(analysis::end_of(span));
    });
    spans.push_back({at.view.inserted_at, at.view.inserted});
    return spans;
}

Json selection_ranges(Workspace& workspace, const Json& params) {
    const At at(workspace, params);
    const bool is_scenario = at.document.language() == Language::scenario;
    Json list = Json::array();
    for (const Json& position : params.value("positions", Json::array())) {
        const std::uint32_t offset = workspace.offset_in(at.view, at.document, position);
        Json outer;
        std::vector<Span> spans = selections_at(at, offset);
        if (spans.empty()) spans.push_back({offset, 0});
        for (auto span = spans.rbegin(); span != spans.rend(); ++span) {
            Json range = {{"range", is_scenario ? workspace.range_json(at.document.lines(), *span)
                                                : workspace.range_json(at.view, *span)}};
            if (!outer.is_null()) range["parent"] = outer;
            outer = std::move(range);
        }
        list.push_back(outer);
    }
    return list;
}

Json code_lenses(Workspace& workspace, const Json& params) {
    const At at(workspace, params);
    Json list = Json::array();
    const std::string& own = at.document.uri();
    const bool is_program = at.document.language() == Language::program;
    const Json top = is_program ? workspace.range_json(at.view, at.program().tree().name.span)
                                : workspace.range_json(at.document.lines(), {0, 0});
    const auto add = [&](const std::string& title, const char* command, Json arguments) {
        list.push_back(lens_json(top, title, command, std::move(arguments)));
    };
    if (at.document.language() == Language::scenario) {
        add("Rehearse", "seqc.rehearse", {at.view.uri, own});
        return list;
    }
    add("Verify", "seqc.verify", {own});
    if (!is_program) return list;
    add("Graph", "seqc.graph", {own});
    add("Rehearse", "seqc.rehearse", {own});
    add("Upload to gateway", "seqc.upload", {own});
    for (const auto& [uri, text] : workspace.dependants_of(own)) {
        if (uri.ends_with(".scn"))
            add("Rehearse " + uri.substr(uri.rfind('/') + 1), "seqc.rehearse", {own, uri});
    }
    return list;
}

}  // namespace

Json lens_json(const Json& range, const std::string& title, const std::string& command, Json arguments) {
    return {{"range", range},
            {"command", {{"title", title}, {"command", command}, {"arguments", std::move(arguments)}}}};
}

Json token_types() {
    return {"keyword", "function", "namespace", "parameter", "variable", "enumMember", "method",
            "number",  "type",     "comment",   "string",    "property", "operator",   "class"};
}

void add_display(Handlers& handlers) {
    handlers["textDocument/hover"] = hover;
    handlers["textDocument/semanticTokens/full"] = tokens_full;
    handlers["textDocument/semanticTokens/range"] = tokens_range;
    handlers["textDocument/inlayHint"] = inlay_hints;
    handlers["textDocument/foldingRange"] = folding;
    handlers["textDocument/selectionRange"] = selection_ranges;
    handlers["textDocument/codeLens"] = code_lenses;
}

}  // namespace nplc::seqc::lsp
