#include "lsp/workspace.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "host/paths.h"
#include "language/lexer.h"
#include "language/names.h"
#include "language/parser.h"
#include "whole_files/whole_files.h"

namespace nplc::seqc::lsp {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostFiles = 500;
/// Search depth for programs that include a file: its folder and those above it.
constexpr int kFoldersUp = 3;

using Kept = std::shared_ptr<const analysis::Program>;

/// Returns the cached program if none of its texts has changed.
Kept kept(Kept& known, Sources sources) {
    const auto same = [&](const Sources& other) {
        return other.text() == sources.text() && other.problems().size() == sources.problems().size() &&
               other.files().size() == sources.files().size();
    };
    if (!known || !same(known->sources())) known = std::make_shared<analysis::Program>(std::move(sources));
    return known;
}

bool is_part(const std::string& text) {
    Report noise;
    return Parser(text, tokens_of(text, noise), noise).at_part();
}

std::vector<std::string> files_in(const std::string& folder, std::string_view ending) {
    std::vector<std::string> files;
    std::error_code error;
    for (fs::directory_iterator entry(host::path_of(folder), error), end; !error && entry != end;
         entry.increment(error)) {
        std::string path = host::name_of(entry->path());
        if (path.ends_with(ending) && files.size() < kMostFiles) files.push_back(std::move(path));
    }
    std::sort(files.begin(), files.end());
    return files;
}

std::string folder_of(const std::string& path) {
    return host::name_of(host::path_of(path).parent_path());
}
std::string stem_of(const std::string& path) {
    return host::name_of(host::path_of(path).stem());
}

/// Among the programs in a folder, the one whose name is a prefix of the file's name.
std::string program_for(const std::string& path) {
    const std::vector<std::string> programs = files_in(folder_of(path), ".seq");
    std::string best;
    for (const std::string& program : programs) {
        const std::string stem = stem_of(program);
        const bool fits = stem_of(path).starts_with(stem);
        if (fits && (best.empty() || stem.size() > stem_of(best).size())) best = program;
    }
    return best.empty() && programs.size() == 1 ? programs.front() : best;
}

std::uint32_t end_of_program(const analysis::Program& program) {
    for (const Token& token : program.tokens()) {
        if (token.kind == TokenKind::identifier && same_name(token.text, "END_PROGRAM"))
            return token.span.offset;
    }
    return program.size();
}

}  // namespace

void Workspace::open(Document document) {
    const std::string uri = document.uri();
    documents_.insert_or_assign(uri, std::move(document));
}

Document* Workspace::find(const std::string& uri) {
    const auto found = documents_.find(uri);
    return found == documents_.end() ? nullptr : &found->second;
}

Document& Workspace::get(const std::string& uri) {
    Document* found = find(uri);
    if (found == nullptr) throw ResponseError(kInvalidParams, fmt::format("'{}' is not open", uri));
    return *found;
}

std::shared_ptr<const analysis::Program> Workspace::read_program(const std::string& path) {
    whole_files::FileText file = whole_files::read_text(path);
    if (!file.error.empty()) return nullptr;
    return kept(files_[path], Sources({path, std::move(file.text)}, reader()));
}

std::shared_ptr<const analysis::Program> Workspace::program_of(const Document& document) {
    const std::string path = path_of_uri(document.uri());
    auto& known = files_[document.uri()];
    if (path.empty()) return kept(known, Sources({document.uri(), document.text()}));
    if (is_part(document.text())) {
        for (const std::string& host : programs_around(path)) {
            std::string text;
            if (!text_of_program(host, text)) continue;
            Sources sources({path, document.text()}, {host, std::move(text)}, reader());
            if (sources.has_first()) return kept(known, std::move(sources));
        }
    }
    return kept(known, Sources({path, document.text()}, reader()));
}

TextReader Workspace::reader() const {
    TextReader files = file_reader();
    const auto identity = files.identity;
    return {[this, files](const std::string& name) -> SourceText {
                const std::string wanted = files.identity(name);
                for (const auto& [uri, document] : documents_) {
                    const std::string path = path_of_uri(uri);
                    if (!path.empty() && files.identity(path) == wanted) return {name, document.text()};
                }
                return files.read(name);
            },
            identity};
}

bool Workspace::text_of_program(const std::string& path, std::string& text) const {
    const SourceText found = reader().read(path);
    text = found.text;
    return found.error.empty();
}

std::string Workspace::uri_of_file(const SourceFile& file) const {
    const TextReader files = file_reader();
    for (const auto& [uri, document] : documents_) {
        const std::string path = path_of_uri(uri);
        if (!path.empty() && files.identity(path) == file.identity) return uri;
    }
    return uri_of_path(file.name);
}

std::vector<std::string> Workspace::programs_around(const std::string& path) const {
    std::vector<std::string> found;
    for (const auto& [uri, document] : documents_) {
        const std::string open = path_of_uri(uri);
        if (document.language() == Language::program && !open.empty() && open != path) found.push_back(open);
    }
    std::string folder = folder_of(path);
    for (int level = 0; level < kFoldersUp && !folder.empty(); ++level) {
        for (std::string& program : files_in(folder, ".seq")) {
            if (program != path) found.push_back(std::move(program));
        }
        const std::string above = folder_of(folder);
        if (above == folder) break;
        folder = above;
    }
    return found;
}

std::map<std::string, std::shared_ptr<const analysis::Program>> Workspace::programs_that_include(
    const SourceFile& file) {
    std::map<std::string, std::shared_ptr<const analysis::Program>> found;
    for (const std::string& path : programs_around(file.name)) {
        std::string text;
        if (!path.ends_with(".seq") || !text_of_program(path, text)) continue;
        Sources sources({path, std::move(text)}, reader());
        const bool includes =
            std::any_of(sources.files().begin(), sources.files().end(),
                        [&](const SourceFile& other) { return other.identity == file.identity; });
        const std::string uri = uri_of_file(sources.program());
        if (includes) found[uri] = std::make_shared<analysis::Program>(std::move(sources));
    }
    return found;
}

bool Workspace::has_parts(const Document& document) {
    if (document.language() != Language::program) return false;
    const auto program = program_of(document);
    return program->is_part() || !program->sources().inclusions().empty();
}

std::shared_ptr<const analysis::Program> Workspace::companion_of(const Document& document, std::string& uri) {
    const std::string path = path_of_uri(document.uri());
    if (path.empty()) return nullptr;
    const std::string program = program_for(path);
    if (program.empty()) return nullptr;
    uri = uri_of_path(program);
    if (const Document* open = find(uri)) return program_of(*open);
    return read_program(program);
}

View Workspace::view_of(const Document& document) {
    View view;
    if (document.language() == Language::program) {
        view.program = program_of(document);
        view.uri = document.uri();
        if (const Sources& sources = view.program->sources();
            &sources.program() != &sources.files().front()) {
            view.part_uri = document.uri();
            view.uri = uri_of_file(sources.program());
        }
        return view;
    }
    const auto companion = companion_of(document, view.uri);
    if (document.language() == Language::scenario) {
        view.program = companion;
        return view;
    }
    const std::string source(companion ? companion->source() : "PROGRAM Unknown\nEND_PROGRAM\n");
    view.inserted_at = companion ? end_of_program(*companion) : 16;
    view.inserted = static_cast<std::uint32_t>(document.text().size());
    view.property_uri = document.uri();
    std::string joined =
        source.substr(0, view.inserted_at) + document.text() + "\n" + source.substr(view.inserted_at);
    view.program =
        kept(files_[document.uri()], Sources({path_of_uri(view.uri), std::move(joined)}, reader()));
    return view;
}

std::map<std::string, std::string> Workspace::dependants_of(const std::string& program_uri) {
    std::map<std::string, std::string> texts;
    const std::string path = path_of_uri(program_uri);
    if (path.empty()) return texts;
    for (const std::string_view ending : {".scn", ".prop"}) {
        for (const std::string& file : files_in(folder_of(path), ending)) {
            if (program_for(file) != path) continue;
            const std::string uri = uri_of_path(file);
            if (whole_files::FileText read = whole_files::read_text(file); read.error.empty())
                texts[uri] = std::move(read.text);
        }
    }
    for (const auto& [uri, document] : documents_) {
        if (document.language() != Language::program && program_for(path_of_uri(uri)) == path)
            texts[uri] = document.text();
    }
    return texts;
}

std::map<std::string, std::shared_ptr<const analysis::Program>> Workspace::programs() {
    std::map<std::string, std::shared_ptr<const analysis::Program>> found;
    for (const std::string& folder : folders) {
        std::error_code error;
        fs::recursive_directory_iterator entry(host::path_of(folder),
                                               fs::directory_options::skip_permission_denied, error);
        for (; !error && entry != fs::recursive_directory_iterator() && found.size() < kMostFiles;
             entry.increment(error)) {
            const std::string path = host::name_of(entry->path());
            if (host::name_of(entry->path().filename()).starts_with('.')) {
                entry.disable_recursion_pending();
            } else if (path.ends_with(".seq")) {
                if (auto program = read_program(path)) found[uri_of_path(path)] = program;
            }
        }
    }
    for (auto& [uri, document] : documents_) {
        if (document.language() == Language::program) found[uri] = program_of(document);
    }
    return found;
}

std::uint32_t Workspace::offset_in(const View& view, const Document& document, const Json& place) const {
    if (!place.is_object() || !place.contains("line") || !place["line"].is_number_unsigned() ||
        !place.contains("character") || !place["character"].is_number_unsigned())
        throw ResponseError(kInvalidParams, "a position has a line and a character, both from 0");
    const auto bounded = [](const Json& number) {
        return static_cast<std::uint32_t>(std::min<std::uint64_t>(number.get<std::uint64_t>(), UINT32_MAX));
    };
    const std::uint32_t offset =
        document.lines().offset_of({bounded(place["line"]), bounded(place["character"])}, encoding);
    return offset + (view.property_uri.empty() ? 0 : view.inserted_at);
}

Json Workspace::range_json(const analysis::Lines& lines, Span span) const {
    const analysis::Range range = lines.range_of(span, encoding);
    return {{"start", {{"line", range.start.line}, {"character", range.start.character}}},
            {"end", {{"line", range.end.line}, {"character", range.end.character}}}};
}

Json Workspace::range_json(const View& view, Span span) const {
    if (view.program && !view.program->is_own(span)) {
        const Sources& sources = view.program->sources();
        const SourceFile& file = sources.file_at(span.offset);
        const analysis::Lines lines(sources.text_of(file));
        return range_json(lines, {span.offset - file.offset, span.length});
    }
    if (view.property_uri.empty()) return range_json(view.program->lines(), span);
    const std::string_view source = view.program->source();
    if (view.in_property_file(span.offset)) {
        const std::string_view own = source.substr(view.inserted_at, view.inserted);
        return range_json(analysis::Lines(own), {span.offset - view.inserted_at, span.length});
    }
    std::string without(source.substr(0, view.inserted_at));
    without += source.substr(view.inserted_at + view.inserted + 1);
    const std::uint32_t shift = span.offset > view.inserted_at ? view.inserted + 1 : 0;
    return range_json(analysis::Lines(without), {span.offset - shift, span.length});
}

std::string Workspace::uri_at(const View& view, Span span) const {
    if (view.program && !view.program->is_own(span))
        return uri_of_file(view.program->sources().file_at(span.offset));
    if (!view.part_uri.empty()) return view.part_uri;
    return view.in_property_file(span.offset) ? view.property_uri : view.uri;
}

Json Workspace::location_json(const View& view, Span span) const {
    return {{"uri", uri_at(view, span)}, {"range", range_json(view, span)}};
}

Span Workspace::span_in(const Document& document, const Json& range) const {
    if (!range.is_object()) throw ResponseError(kInvalidParams, "a range has a start and an end");
    const std::uint32_t from = offset_in({}, document, range.value("start", Json()));
    const std::uint32_t to = offset_in({}, document, range.value("end", Json()));
    return {from, to > from ? to - from : 0};
}

}  // namespace nplc::seqc::lsp
