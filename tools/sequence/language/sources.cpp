#include "seqc/sources.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "diagnostics/report.h"
#include "host/paths.h"
#include "language/lexer.h"
#include "language/names.h"

namespace nplc::seqc {
namespace {

constexpr std::size_t kDeepestInclude = 20;
constexpr std::string_view kInclude = "INCLUDE";

/// Avoids a second pass for the most frequent case, a program without INCLUDE.
bool may_include(std::string_view text) {
    const auto same = [](char a, char b) { return static_cast<char>(a & ~0x20) == b; };
    return std::search(text.begin(), text.end(), kInclude.begin(), kInclude.end(), same) != text.end();
}

/// The texts after INCLUDE, with their quotes.
std::vector<Token> inclusions_in(std::string_view text) {
    std::vector<Token> found;
    if (!may_include(text)) return found;
    Report noise;
    const std::vector<Token> tokens = tokens_of(text, noise);
    for (std::size_t i = 0; i + 1 < tokens.size(); ++i) {
        const std::string_view path = tokens[i + 1].text;
        const bool is_quoted = path.size() > 1 && path.front() == '\'' && path.back() == '\'';
        if (same_name(tokens[i].text, kInclude) && tokens[i + 1].kind == TokenKind::text && is_quoted)
            found.push_back(tokens[i + 1]);
    }
    return found;
}

bool is_text(std::string_view text) {
    return std::none_of(text.begin(), text.end(), [](char c) {
        const bool is_control = static_cast<unsigned char>(c) < ' ' || c == 0x7F;
        return is_control && std::string_view("\t\n\v\f\r").find(c) == std::string_view::npos;
    });
}

}  // namespace

std::vector<Token> tokens_of(const Sources& sources, const SourceFile& file, Report& report) {
    Report own;
    std::vector<Token> tokens = tokens_of(sources.text_of(file), own);
    for (Token& token : tokens) token.span.offset += file.offset;
    if (own.has_more()) report.note_more();
    for (Diagnostic& diagnostic : own.take()) {
        diagnostic.span.offset += file.offset;
        for (Note& note : diagnostic.notes) note.span.offset += file.offset;
        report.add(std::move(diagnostic));
    }
    return tokens;
}

class SourceLoader {
  public:
    SourceLoader(Sources& sources, const TextReader& reader) : sources_(sources), reader_(reader) {}

    std::size_t add(SourceText text) {
        SourceFile file{std::move(text.name),
                        {},
                        static_cast<std::uint32_t>(sources_.text_.size()),
                        static_cast<std::uint32_t>(text.text.size())};
        if (!sources_.files_.empty()) {
            sources_.text_ += '\n';
            ++file.offset;
        }
        if (reader_.identity) file.identity = reader_.identity(file.name);
        sources_.text_ += text.text;
        sources_.files_.push_back(std::move(file));
        return sources_.files_.size() - 1;
    }

    void follow(std::size_t at) {
        open_.push_back(at);
        const std::string text(sources_.text_of(sources_.files_[at]));
        for (const Token& path : inclusions_in(text)) include(at, path);
        open_.pop_back();
    }

    void expect_first() {
        awaits_first_ = true;
        sources_.has_first_ = false;
    }

  private:
    std::string name_beside(std::size_t including, std::string_view written) const {
        const auto folder = host::path_of(sources_.files_[including].name).parent_path();
        return host::name_of((folder / host::path_of(written)).lexically_normal());
    }

    std::optional<std::size_t> known(const std::string& identity) const {
        const auto found = std::find_if(sources_.files_.begin(), sources_.files_.end(),
                                        [&](const SourceFile& file) { return file.identity == identity; });
        if (found == sources_.files_.end()) return std::nullopt;
        return static_cast<std::size_t>(found - sources_.files_.begin());
    }

    Diagnostic& fail(Sources::Inclusion& inclusion, Code code, Span span, std::string message,
                     std::string help) {
        inclusion.failed = true;
        Report report;
        report.add(code, span, std::move(message), std::move(help));
        sources_.problems_.push_back(report.last());
        return sources_.problems_.back();
    }

    void include(std::size_t including, const Token& path) {
        const Span span{sources_.files_[including].offset + path.span.offset, path.span.length};
        Sources::Inclusion& inclusion = sources_.inclusions_[span.offset];
        const std::string_view written = path.text.substr(1, path.text.size() - 2);
        if (!reader_.read) {
            fail(inclusion, "E024", span, "INCLUDE needs a program that stands in a file",
                 "write what the file holds in its place");
            return;
        }
        if (written.empty()) {
            fail(inclusion, "E024", span, "INCLUDE names no file", "write INCLUDE 'wiring.seqi';");
            return;
        }
        const std::string name = name_beside(including, written);
        if (const auto there = known(reader_.identity(name))) return take_known(inclusion, *there, span);
        if (open_.size() >= kDeepestInclude) {
            fail(inclusion, "E025", span,
                 fmt::format("files include each other more than {} deep", kDeepestInclude),
                 "include the files in the program itself");
            return;
        }
        take_new(inclusion, name, span);
    }

    /// Included once; but a file that is still open would include itself.
    void take_known(Sources::Inclusion& inclusion, std::size_t there, Span span) {
        inclusion.meant = there;
        if (awaits_first_ && there == 0) {
            awaits_first_ = false;
            sources_.has_first_ = true;
            inclusion.file = there;
            return enter(there, span);
        }
        const auto open = std::find(open_.begin(), open_.end(), there);
        if (open == open_.end()) return;
        Diagnostic& problem =
            fail(inclusion, "E025", span, fmt::format("'{}' includes itself", sources_.files_[there].name),
                 "leave this INCLUDE out, or put what both need into a third file");
        for (auto at = open + 1; at != open_.end(); ++at)
            problem.notes.push_back({included_at_.at(*at), "by way of this INCLUDE"});
    }

    void take_new(Sources::Inclusion& inclusion, const std::string& name, Span span) {
        SourceText text = reader_.read(name);
        if (text.error.empty() && !is_text(text.text))
            text.error =
                fmt::format("cannot include '{}': it is not a text: it contains control characters", name);
        if (!text.error.empty()) {
            fail(inclusion, "E024", span, text.error,
                 name.find('\\') != std::string::npos
                     ? "write / between folders, on Windows too"
                     : "the name counts from the folder of the file in which this INCLUDE stands");
            return;
        }
        if (sources_.text_.size() + text.text.size() > kLongestSource) {
            fail(inclusion, "E024", span, "the program and what it includes are larger than 16 MiB",
                 "name a file of declarations");
            return;
        }
        text.name = name;
        const std::size_t added = add(std::move(text));
        inclusion.file = inclusion.meant = added;
        enter(added, span);
    }

    void enter(std::size_t file, Span span) {
        included_at_[file] = span;
        follow(file);
    }

    Sources& sources_;
    const TextReader& reader_;
    std::vector<std::size_t> open_;
    std::map<std::size_t, Span> included_at_;
    bool awaits_first_ = false;
};

Sources::Sources(SourceText program, const TextReader& reader) {
    SourceLoader loader(*this, reader);
    loader.follow(loader.add(std::move(program)));
}

Sources::Sources(SourceText first, SourceText program, const TextReader& reader) {
    SourceLoader loader(*this, reader);
    loader.add(std::move(first));
    loader.expect_first();
    program_ = loader.add(std::move(program));
    loader.follow(program_);
}

const SourceFile& Sources::file_at(std::uint32_t offset) const {
    const auto behind =
        std::upper_bound(files_.begin() + 1, files_.end(), offset,
                         [](std::uint32_t at, const SourceFile& file) { return at < file.offset; });
    return *(behind - 1);
}

const Sources::Inclusion* Sources::inclusion_at(std::uint32_t offset) const {
    const auto found = inclusions_.find(offset);
    return found == inclusions_.end() ? nullptr : &found->second;
}

Places::Places(const Sources& sources) : sources_(sources) {
    for (const SourceFile& file : sources.files()) positions_.emplace_back(sources.text_of(file));
}

ShownPlace Places::of(std::uint32_t offset) const {
    const SourceFile& file = sources_.file_at(offset);
    const auto index = static_cast<std::size_t>(&file - sources_.files().data());
    return {&file, positions_[index].of(offset - file.offset)};
}

std::string Places::line_text(std::uint32_t offset) const {
    const ShownPlace place = of(offset);
    const std::string line = std::to_string(place.at.line);
    return place.file == &sources_.program() ? line : fmt::format("{}:{}", place.file->name, line);
}

}  // namespace nplc::seqc
