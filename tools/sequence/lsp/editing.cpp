#include <fmt/format.h>

#include <algorithm>

#include "editing/completion.h"
#include "editing/fixes.h"
#include "editing/layout.h"
#include "editing/register_text.h"
#include "language/names.h"
#include "lsp/features.h"
#include "lsp/scenario_shape.h"
#include "lsp/scenario_words.h"

namespace nplc::seqc::lsp {
namespace {

using analysis::Proposal;

int item_kind(Proposal::Kind kind) {
    switch (kind) {
        case Proposal::Kind::keyword:
            return 14;
        case Proposal::Kind::step:
            return 3;  // Function
        case Proposal::Kind::group:
            return 9;  // Module
        case Proposal::Kind::signal:
            return 6;  // Variable
        case Proposal::Kind::register_name:
            return 21;  // Constant
        case Proposal::Kind::command:
            return 2;  // Method
        case Proposal::Kind::unit:
            return 11;
        case Proposal::Kind::value:
            return 12;
        case Proposal::Kind::motor:
            return 7;  // Class
        case Proposal::Kind::snippet:
            return 15;
    }
    return 1;
}

/// Without the marks of a snippet, for clients that do not support them.
std::string plain(const std::string& snippet) {
    std::string text;
    for (std::size_t at = 0; at < snippet.size(); ++at) {
        if (snippet[at] != '$' || at + 1 >= snippet.size()) {
            text += snippet[at];
        } else if (snippet[at + 1] == '{') {
            const std::size_t colon = snippet.find_first_of(":}", at);
            const std::size_t end = snippet.find('}', at);
            if (snippet[colon] == ':') text += snippet.substr(colon + 1, end - colon - 1);
            at = end;
        } else {
            ++at;
        }
    }
    return text;
}

Json item_json(const Workspace& workspace, const View& view, const analysis::Proposals& proposals,
               const Proposal& proposal, const std::string& uri, std::size_t index) {
    const bool snippet = proposal.is_snippet && workspace.snippets;
    const std::string text = proposal.is_snippet && !snippet ? plain(proposal.insert) : proposal.insert;
    Json item = {{"label", proposal.label},
                 {"kind", item_kind(proposal.kind)},
                 {"insertTextFormat", snippet ? 2 : 1},
                 {"sortText", fmt::format("{:04}", index)},
                 {"filterText", proposal.label},
                 {"textEdit", {{"range", workspace.range_json(view, proposals.replaced)}, {"newText", text}}},
                 {"data", {{"uri", uri}, {"kind", static_cast<int>(proposal.kind)}}}};
    if (!proposal.detail.empty()) item["detail"] = proposal.detail;
    return item;
}

Json completion(Workspace& workspace, const Json& params) {
    const At at(workspace, params);
    if (at.document.language() == Language::scenario) return scenario_completion(workspace, at);
    const analysis::Proposals proposals = analysis::complete(at.program(), at.offset);
    Json items = Json::array();
    for (std::size_t i = 0; i < proposals.list.size(); ++i)
        items.push_back(item_json(workspace, at.view, proposals, proposals.list[i], at.document.uri(), i));
    return {{"isIncomplete", false}, {"items", items}};
}

/// The documentation of an item is computed when it is requested.
Json resolve_completion(Workspace& workspace, const Json& params) {
    Json item = params;
    const std::string label = params.value("label", "");
    const Json data = params.value("data", Json::object());
    const Document* document = workspace.find(data.value("uri", ""));
    std::string text;
    if (document != nullptr && document->language() != Language::scenario) {
        const View view = workspace.view_of(*document);
        const auto* reg = view.program->register_named(label);
        const auto kind = static_cast<Proposal::Kind>(data.value("kind", 0));
        if (reg != nullptr && kind == Proposal::Kind::register_name)
            text = analysis::register_text(*view.program, *reg);
    }
    if (text.empty()) text = analysis::documentation_of(upper(label.substr(0, label.find('.'))));
    if (!text.empty()) item["documentation"] = {{"kind", "markdown"}, {"value", text}};
    return item;
}

Json signature_help(Workspace& workspace, const Json& params) {
    const At at(workspace, params);
    if (at.document.language() == Language::scenario) return Json();
    const auto signatures = analysis::signatures_at(at.program(), at.offset);
    if (signatures.empty()) return Json();
    Json list = Json::array();
    for (const analysis::Signature& signature : signatures) {
        Json parameters = Json::array();
        for (const std::string& parameter : signature.parameters)
            parameters.push_back({{"label", parameter}});
        list.push_back({{"label", signature.label},
                        {"documentation", {{"kind", "markdown"}, {"value", signature.documentation}}},
                        {"parameters", parameters}});
    }
    return {{"signatures", list}, {"activeSignature", 0}, {"activeParameter", signatures.front().active}};
}

/// Converts to the program of the document: the text of a property file is inserted in it.
Span range_of(const Workspace& workspace, const At& at, const Json& params) {
    Span range = workspace.span_in(at.document, params.value("range", Json()));
    range.offset += at.view.inserted_at;
    return range;
}

bool is_in_document(const At& at, Span span) {
    return at.view.property_uri.empty() ||
           (at.view.in_property_file(span.offset) && at.view.in_property_file(analysis::end_of(span)));
}

Json laid_out(Workspace& workspace, const At& at, const analysis::Layout& layout) {
    if (!layout.error.empty()) throw ResponseError(kRequestFailed, layout.error);
    Json list = Json::array();
    for (const analysis::TextEdit& edit : layout.edits) {
        if (is_in_document(at, edit.span))
            list.push_back({{"range", workspace.range_json(at.view, edit.span)}, {"newText", edit.text}});
    }
    return list;
}

Json formatting(Workspace& workspace, const Json& params) {
    const At at(workspace, params);
    if (at.document.language() == Language::scenario) return Json::array();
    if (at.document.language() == Language::program)
        return laid_out(workspace, at, analysis::format_whole(at.program()));
    return laid_out(workspace, at,
                    analysis::format_range(at.program(), {at.view.inserted_at, at.view.inserted}));
}

Json range_formatting(Workspace& workspace, const Json& params) {
    const At at(workspace, params);
    if (at.document.language() == Language::scenario) return Json::array();
    return laid_out(workspace, at, analysis::format_range(at.program(), range_of(workspace, at, params)));
}

Json typed_formatting(Workspace& workspace, const Json& params) {
    const At at(workspace, params);
    if (at.document.language() == Language::scenario) return Json::array();
    return laid_out(workspace, at,
                    analysis::format_typed(at.program(), at.offset, params.value("ch", "\n") == "\n"));
}

bool overlap(Span a, Span b) {
    return a.offset <= analysis::end_of(b) && b.offset <= analysis::end_of(a);
}

Json action_json(const Workspace& workspace, const At& at, const analysis::Fix& fix, const Json& diagnostic) {
    Json changes = Json::object();
    for (const analysis::TextEdit& edit : fix.edits) {
        const Json location = workspace.location_json(at.view, edit.span);
        changes[location["uri"].get<std::string>()].push_back(
            {{"range", location["range"]}, {"newText", edit.text}});
    }
    Json action = {{"title", fix.title},
                   {"kind", "quickfix"},
                   {"isPreferred", fix.preferred},
                   {"edit", {{"changes", std::move(changes)}}}};
    if (!diagnostic.is_null()) action["diagnostics"] = Json::array({diagnostic});
    return action;
}

/// The preferred fix of every diagnostic, without overlapping ones.
void add_fix_all(const Workspace& workspace, const At& at, Json& actions) {
    analysis::Fix all{"Do all that the messages advise", {}, false};
    std::size_t fixed = 0;
    for (const Diagnostic& diagnostic : at.program().compiled().diagnostics) {
        if (!at.program().is_own(diagnostic.span)) continue;
        if (!is_in_document(at, diagnostic.span)) continue;
        const auto fixes = analysis::fixes_for(at.program(), diagnostic);
        if (fixes.empty() || !fixes.front().preferred) continue;
        const auto clashes = [&](const analysis::TextEdit& edit) {
            return std::any_of(all.edits.begin(), all.edits.end(), [&](const analysis::TextEdit& other) {
                return overlap(edit.span, other.span);
            });
        };
        if (std::any_of(fixes.front().edits.begin(), fixes.front().edits.end(), clashes)) continue;
        all.edits.insert(all.edits.end(), fixes.front().edits.begin(), fixes.front().edits.end());
        ++fixed;
    }
    if (fixed == 0) return;
    Json action = action_json(workspace, at, all, Json());
    action["kind"] = "source.fixAll";
    actions.push_back(std::move(action));
}

bool wanted(const Json& params, std::string_view kind) {
    const Json only = params.value("/context/only"_json_pointer, Json());
    if (!only.is_array() || only.empty()) return true;
    return std::any_of(only.begin(), only.end(), [&](const Json& one) {
        return one.is_string() && kind.starts_with(one.get_ref<const std::string&>());
    });
}

Json code_actions(Workspace& workspace, const Json& params) {
    Json actions = Json::array();
    const At at(workspace, params);
    if (at.document.language() == Language::scenario)
        return wanted(params, "quickfix") ? scenario_fixes(workspace, at, params) : actions;
    const Span range = range_of(workspace, at, params);
    const Json told = params.value("/context/diagnostics"_json_pointer, Json::array());
    for (const Diagnostic& diagnostic : at.program().compiled().diagnostics) {
        if (!at.program().is_own(diagnostic.span)) continue;
        if (!overlap(diagnostic.span, range) || !wanted(params, "quickfix") ||
            !is_in_document(at, diagnostic.span))
            continue;
        Json shown;
        for (const Json& one : told) {
            if (one.is_object() && one.value("code", "") == diagnostic.code && one.contains("range") &&
                one["range"] == workspace.range_json(at.view, diagnostic.span))
                shown = one;
        }
        for (const analysis::Fix& fix : analysis::fixes_for(at.program(), diagnostic))
            actions.push_back(action_json(workspace, at, fix, shown));
    }
    for (const Json& one : told) {
        if (!one.is_object() || !one.contains("code") || !one["code"].is_string() ||
            !wanted(params, "quickfix"))
            continue;
        const std::string code = one["code"].get<std::string>();
        const ast::Step* step = at.program().step_at(range.offset);
        if (!code.starts_with("V") || step == nullptr) continue;
        for (const analysis::Fix& fix : analysis::allow_in(at.program(), step->name.span, code))
            actions.push_back(action_json(workspace, at, fix, one));
    }
    if (wanted(params, "source.fixAll")) add_fix_all(workspace, at, actions);
    return actions;
}

}  // namespace

void add_editing(Handlers& handlers) {
    handlers["textDocument/completion"] = completion;
    handlers["completionItem/resolve"] = resolve_completion;
    handlers["textDocument/signatureHelp"] = signature_help;
    handlers["textDocument/formatting"] = formatting;
    handlers["textDocument/rangeFormatting"] = range_formatting;
    handlers["textDocument/onTypeFormatting"] = typed_formatting;
    handlers["textDocument/codeAction"] = code_actions;
}

}  // namespace nplc::seqc::lsp
