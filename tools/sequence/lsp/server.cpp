#include "lsp/server.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "lsp/commands.h"

namespace nplc::seqc::lsp {
namespace {

constexpr int kVerifyError = 1;

std::string text_of(const Json& object, const char* pointer) {
    const Json value = object.value(Json::json_pointer(pointer), Json());
    return value.is_string() ? value.get<std::string>() : "";
}

Json finding_json(const Workspace& workspace, const View& view, const Finding& finding) {
    Json json = {{"range", workspace.range_json(view, finding.span)},
                 {"severity", static_cast<int>(finding.level) + kVerifyError},
                 {"source", "seqc verify"},
                 {"message", finding.message}};
    if (!finding.code.empty()) json["code"] = finding.code;
    Json related = Json::array();
    for (const Note& note : finding.related)
        related.push_back(
            {{"location", workspace.location_json(view, note.span)}, {"message", note.message}});
    if (!related.empty()) json["relatedInformation"] = related;
    if (!finding.scenario.empty()) json["data"] = {{"counterexample", finding.name}};
    return json;
}

Json capabilities(analysis::Encoding encoding) {
    return {
        {"positionEncoding", encoding == analysis::Encoding::utf8 ? "utf-8" : "utf-16"},
        {"textDocumentSync", {{"openClose", true}, {"change", 2}, {"save", {{"includeText", false}}}}},
        {"completionProvider", {{"triggerCharacters", {".", "=", ":", "%", "("}}, {"resolveProvider", true}}},
        {"hoverProvider", true},
        {"signatureHelpProvider", {{"triggerCharacters", {"(", ","}}}},
        {"definitionProvider", true},
        {"declarationProvider", true},
        {"referencesProvider", true},
        {"documentHighlightProvider", true},
        {"documentSymbolProvider", true},
        {"workspaceSymbolProvider", true},
        {"codeActionProvider", {{"codeActionKinds", {"quickfix", "source.fixAll"}}}},
        {"codeLensProvider", {{"resolveProvider", false}}},
        {"documentFormattingProvider", true},
        {"documentRangeFormattingProvider", true},
        {"documentOnTypeFormattingProvider",
         {{"firstTriggerCharacter", "\n"}, {"moreTriggerCharacter", {"F", "E", "P", "R", ";"}}}},
        {"documentLinkProvider", {{"resolveProvider", false}}},
        {"renameProvider", {{"prepareProvider", true}}},
        {"foldingRangeProvider", true},
        {"selectionRangeProvider", true},
        {"semanticTokensProvider",
         {{"legend", {{"tokenTypes", token_types()}, {"tokenModifiers", {"declaration", "readonly"}}}},
          {"full", true},
          {"range", true}}},
        {"inlayHintProvider", true},
        {"executeCommandProvider",
         {{"commands", {"seqc.verify.results", "seqc.counterexample", "seqc.dot", "seqc.describe"}}}}};
}

analysis::Encoding negotiated(const Json& params) {
    const Json offered = params.value("/capabilities/general/positionEncodings"_json_pointer, Json());
    const bool utf8 =
        offered.is_array() && std::find(offered.begin(), offered.end(), "utf-8") != offered.end();
    return utf8 ? analysis::Encoding::utf8 : analysis::Encoding::utf16;
}

std::vector<std::string> folders_in(const Json& params) {
    std::vector<std::string> folders;
    for (const Json& folder :
         params.value("workspaceFolders", Json()).is_array() ? params["workspaceFolders"] : Json::array()) {
        if (std::string path = path_of_uri(text_of(folder, "/uri")); !path.empty())
            folders.push_back(std::move(path));
    }
    if (folders.empty()) {
        if (std::string path = path_of_uri(text_of(params, "/rootUri")); !path.empty())
            folders.push_back(std::move(path));
    }
    return folders;
}

}  // namespace

At::At(Workspace& workspace, const Json& params)
    : document(workspace.get(text_of(params, "/textDocument/uri"))), view(workspace.view_of(document)) {
    if (params.contains("position")) offset = workspace.offset_in(view, document, params["position"]);
}

const analysis::Program& At::program() const {
    if (!view.program) throw ResponseError(kRequestFailed, "there is no program for this file");
    return *view.program;
}

Server::Server(Send send) : send_(std::move(send)) {
    add_navigation(handlers_);
    add_display(handlers_);
    add_editing(handlers_);
}

void Server::respond(const Json& id, Json result) {
    send_({{"jsonrpc", "2.0"}, {"id", id}, {"result", std::move(result)}});
}

void Server::refuse(const Json& id, int code, const std::string& message) {
    send_({{"jsonrpc", "2.0"}, {"id", id}, {"error", {{"code", code}, {"message", message}}}});
}

void Server::notify(const std::string& method, Json params) {
    send_({{"jsonrpc", "2.0"}, {"method", method}, {"params", std::move(params)}});
}

void Server::malformed(const std::string& problem) {
    refuse(nullptr, kParseError, problem);
}

void Server::cancelled(const Json& message) {
    refuse(message["id"], kRequestCancelled, "cancelled");
}

void Server::receive(const Json& message) {
    const std::string method = text_of(message, "/method");
    const bool has_id = message.contains("id") && !message["id"].is_null();
    if (method.empty()) {
        const bool is_answer = has_id && (message.contains("result") || message.contains("error"));
        if (!is_answer) refuse(has_id ? message["id"] : Json(), kInvalidRequest, "a message without method");
        return;
    }
    const Json params = message.value("params", Json::object());
    if (has_id) return request(message["id"], method, params.is_null() ? Json::object() : params);
    try {
        notification(method, params);
    } catch (const std::exception& problem) {
        notify("window/logMessage",
               {{"type", 1}, {"message", fmt::format("{}: {}", method, problem.what())}});
    }
}

void Server::request(const Json& id, const std::string& method, const Json& params) {
    try {
        respond(id, answer(method, params));
    } catch (const ResponseError& refusal) {
        refuse(id, refusal.code, refusal.what());
    } catch (const Json::exception& problem) {
        refuse(id, kInvalidParams, problem.what());
    }
}

Json Server::answer(const std::string& method, const Json& params) {
    if (method == "initialize") return initialize(params);
    if (!initialized_) throw ResponseError(kServerNotInitialized, "initialize comes first");
    if (shut_down_) throw ResponseError(kInvalidRequest, "the server is shut down: only exit is left");
    if (method == "shutdown") {
        shut_down_ = true;
        return Json();
    }
    if (method == "workspace/executeCommand") return execute(params);
    if (method == "textDocument/codeLens") return lenses(params);
    const auto handler = handlers_.find(method);
    if (handler == handlers_.end())
        throw ResponseError(kMethodNotFound, fmt::format("there is no '{}' here", method));
    return handler->second(workspace_, params);
}

Json Server::initialize(const Json& params) {
    if (initialized_) throw ResponseError(kInvalidRequest, "initialize was sent twice");
    initialized_ = true;
    workspace_.encoding = negotiated(params);
    workspace_.folders = folders_in(params);
    workspace_.snippets = params.value(
        "/capabilities/textDocument/completion/completionItem/snippetSupport"_json_pointer, false);
    refreshes_lenses_ =
        params.value("/capabilities/workspace/codeLens/refreshSupport"_json_pointer, Json()) == Json(true);
    configure(params.value("initializationOptions", Json()));
    return {{"capabilities", capabilities(workspace_.encoding)},
            {"serverInfo", {{"name", "seqc"}, {"version", NPLC_VERSION}}}};
}

void Server::configure(const Json& settings) {
    const Json own = settings.is_object() && settings.contains("seqc") ? settings["seqc"] : settings;
    if (own.is_object() && own.value("verify", Json()).is_boolean()) verifies_ = own["verify"].get<bool>();
}

void Server::notification(const std::string& method, const Json& params) {
    if (method == "exit") {
        exit_code_ = shut_down_ ? 0 : 1;
    } else if (!initialized_ || shut_down_) {
        return;
    } else if (method == "textDocument/didOpen") {
        did_open(params);
    } else if (method == "textDocument/didChange") {
        did_change(params);
    } else if (method == "textDocument/didClose") {
        did_close(params);
    } else if (method == "workspace/didChangeConfiguration") {
        configure(params.value("settings", Json()));
    } else if (method == "workspace/didChangeWatchedFiles") {
        for (auto& [uri, document] : workspace_.documents()) {
            if (document.language() != Language::program || workspace_.has_parts(document))
                document.changed = true;
        }
    }
}

void Server::did_open(const Json& params) {
    const Json& item = params.at("textDocument");
    const std::string uri = item.at("uri").get<std::string>();
    workspace_.open({uri, language_of(uri, item.value("languageId", "")),
                     item.value("version", std::int64_t{0}), item.at("text").get<std::string>()});
    verdicts_.erase(uri);
}

void Server::did_change(const Json& params) {
    const Json& item = params.at("textDocument");
    Document& document = workspace_.get(item.at("uri").get<std::string>());
    if (!document.change(params.at("contentChanges"), item.value("version", document.version() + 1),
                         workspace_.encoding))
        notify("window/logMessage",
               {{"type", 1},
                {"message",
                 "textDocument/didChange: a change without text or with a malformed range; the text here may "
                 "differ from the editor's: close and open it"}});
    verdicts_.erase(document.uri());
}

void Server::did_close(const Json& params) {
    const std::string uri = params.at("textDocument").at("uri").get<std::string>();
    workspace_.close(uri);
    verdicts_.erase(uri);
    unverified_.erase(uri);
    publish_others(uri, {});
    notify("textDocument/publishDiagnostics", {{"uri", uri}, {"diagnostics", others_of(uri)}});
    for (auto& [other, document] : workspace_.documents()) document.changed = true;
}

Json Server::others_of(const std::string& uri) const {
    Json all = Json::array();
    const auto found = others_.find(uri);
    if (found == others_.end()) return all;
    for (const auto& [program, list] : found->second) {
        for (const Json& diagnostic : list) {
            if (std::find(all.begin(), all.end(), diagnostic) == all.end()) all.push_back(diagnostic);
        }
    }
    return all;
}

void Server::publish(Document& document) {
    std::map<std::string, Json> lists = diagnostics_of(workspace_, document);
    const auto verdict = verdicts_.find(document.uri());
    if (verdict != verdicts_.end()) {
        const View view = workspace_.view_of(document);
        for (const Finding& finding : verdict->second.findings) {
            const std::string uri = workspace_.uri_at(view, finding.span);
            lists[uri.empty() ? document.uri() : uri].push_back(finding_json(workspace_, view, finding));
        }
    }
    Json list = std::exchange(lists[document.uri()], Json::array());
    if (list.is_null()) list = Json::array();
    lists.erase(document.uri());
    notify("textDocument/publishDiagnostics",
           {{"uri", document.uri()}, {"version", document.version()}, {"diagnostics", std::move(list)}});
    publish_others(document.uri(), std::move(lists));
}

/// Diagnostics of programs for included files that are not open, merged over all programs.
void Server::publish_others(const std::string& program, std::map<std::string, Json> lists) {
    std::set<std::string> touched;
    for (auto& [uri, by_program] : others_) {
        if (by_program.erase(program) > 0) touched.insert(uri);
    }
    for (auto& [uri, list] : lists) {
        others_[uri][program] = std::move(list);
        touched.insert(uri);
    }
    for (const std::string& uri : touched) {
        if (workspace_.find(uri) != nullptr) continue;  // it publishes its own
        notify("textDocument/publishDiagnostics", {{"uri", uri}, {"diagnostics", others_of(uri)}});
    }
}

void Server::catch_up() {
    bool program_changed = false;
    for (auto& [uri, document] : workspace_.documents())
        program_changed = program_changed || (document.changed && document.language() == Language::program);
    for (auto& [uri, document] : workspace_.documents()) {
        const bool follows =
            program_changed && (document.language() != Language::program || workspace_.has_parts(document));
        if (!document.changed && !follows) continue;
        if (document.changed && document.language() != Language::scenario && verifies_)
            unverified_.insert(uri);
        if (follows && document.language() != Language::scenario) {
            verdicts_.erase(uri);
            if (verifies_) unverified_.insert(uri);
        }
        document.changed = false;
        publish(document);
    }
}

/// Empty for a scenario, a program with errors, or properties without a program.
std::optional<VerifyJob> Server::job_of(const Document& document) {
    if (document.language() == Language::scenario) return std::nullopt;
    const View view = workspace_.view_of(document);
    if (!view.program || view.uri.empty() || view.program->is_part() || !view.program->compiled().ok)
        return std::nullopt;
    return VerifyJob{document.uri(), document.version(), view.program->sources()};
}

std::vector<VerifyJob> Server::take_jobs() {
    std::vector<VerifyJob> jobs;
    for (const std::string& uri : std::exchange(unverified_, {})) {
        const Document* document = workspace_.find(uri);
        if (document == nullptr) continue;
        if (auto job = job_of(*document)) jobs.push_back(std::move(*job));
    }
    return jobs;
}

/// For a property file only the verdicts on its own properties: its program shows the others.
void Server::keep(VerifyOutcome outcome, const Document& document) {
    const View view = workspace_.view_of(document);
    if (!view.property_uri.empty()) {
        std::erase_if(outcome.findings, [&](const Finding& finding) {
            return !finding.code.empty() || !view.in_property_file(finding.span.offset);
        });
    }
    verdicts_.insert_or_assign(document.uri(), std::move(outcome));
}

void Server::verified(const VerifyOutcome& outcome) {
    Document* document = workspace_.find(outcome.uri);
    if (document == nullptr || document->version() != outcome.version) return;
    const auto job = job_of(*document);
    if (!job || job->sources.text() != outcome.source)
        return;  // the program of these properties has changed meanwhile
    keep(outcome, *document);
    publish(*document);
    if (refreshes_lenses_)
        send_({{"jsonrpc", "2.0"},
               {"id", fmt::format("seqc-{}", ++asked_)},
               {"method", "workspace/codeLens/refresh"}});
}

Json Server::lenses(const Json& params) {
    Json list = handlers_.find("textDocument/codeLens")->second(workspace_, params);
    const At at(workspace_, params);
    const auto verdict = verdicts_.find(at.document.uri());
    if (verdict == verdicts_.end()) return list;
    for (const Finding& finding : verdict->second.findings) {
        if (!finding.scenario.empty())
            list.push_back(lens_json(workspace_.range_json(at.view, finding.span),
                                     "Rehearse how it breaks: " + finding.name, "seqc.counterexample.open",
                                     {at.document.uri(), finding.name}));
    }
    return list;
}

Json Server::execute(const Json& params) {
    const std::string command = text_of(params, "/command");
    const std::string uri = text_of(params, "/arguments/0");
    Document& document = workspace_.get(uri);
    if (command == "seqc.dot") return dot_of(workspace_, document);
    if (command == "seqc.describe") return description_of(workspace_, document);
    if (command != "seqc.verify.results" && command != "seqc.counterexample")
        throw ResponseError(kInvalidParams, fmt::format("there is no command '{}'", command));
    if (!verdicts_.contains(uri)) {
        const auto job = job_of(document);
        if (!job) throw ResponseError(kRequestFailed, "there is no program without errors to be verified");
        keep(verify_program(*job), document);
        publish(document);
    }
    const VerifyOutcome& outcome = verdicts_.at(uri);
    if (command == "seqc.verify.results") return results_of(outcome);
    Json shown = counterexample_of(outcome, text_of(params, "/arguments/1"));
    shown["program"] = workspace_.view_of(document).uri;
    return shown;
}

}  // namespace nplc::seqc::lsp
