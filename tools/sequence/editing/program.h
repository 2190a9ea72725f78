#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "compiler/scope.h"
#include "diagnostics/report.h"
#include "editing/text.h"
#include "language/ast.h"
#include "language/token.h"
#include "seqc/seqc.h"

/// Analysis of one version of a program. The results depend on its text only.
namespace nplc::seqc::analysis {

enum class Kind : std::uint8_t {
    program,
    step,
    group,
    input,
    output,
    motor_variable,
    constant,
    property,
    sequence,
    parameter,
    set_point
};

struct Definition {
    Kind kind = Kind::program;
    std::string_view name;
    Span name_span;
    Span whole;                ///< the block or declaration
    std::string_view address;  ///< for an input, output, name of VAR_MOTOR or set-point with AT, as written
    bool is_inverted = false;  ///< an input at NOT its address
};

struct Reference {
    static constexpr std::size_t kNone = ~std::size_t{0};

    Span span;
    ast::Role role = ast::Role::other;
    std::size_t definition =
        kNone;  ///< index in definitions(); kNone: an address, a register of the map, an unknown name
    bool declares = false;
};

/// A constant that the compiler converts to a register's raw value.
struct Constant {
    Span span;
    const registers::Register* reg = nullptr;
    std::uint32_t bits = 0;
    std::int64_t raw = 0;  ///< with the register's sign
};

class Program {
  public:
    explicit Program(std::string source);
    /// The first file is the analysed one: a program, or a file that it includes.
    explicit Program(Sources sources);
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;

    /// Text of the analysed file; text of other files follows beyond its size().
    std::string_view source() const { return sources_.text_of(own_file()); }
    const Sources& sources() const { return sources_; }
    const SourceFile& own_file() const { return sources_.files().front(); }
    /// The file is an include file.
    bool is_part() const { return is_part_; }
    bool is_own(Span span) const { return span.offset <= size(); }
    ShownPlace place_of(std::uint32_t offset) const { return Places(sources_).of(offset); }
    const Lines& lines() const { return lines_; }
    /// Without comments; the end token is the last.
    const std::vector<Token>& tokens() const { return tokens_; }
    const std::vector<Token>& comments() const { return comments_; }
    const ast::Program& tree() const { return tree_; }
    /// Syntax errors.
    const std::vector<Diagnostic>& grammar() const { return grammar_; }
    /// The compiler's result; computed on first use.
    const Compilation& compiled() const;

    const std::vector<Definition>& definitions() const { return definitions_; }
    const std::vector<Reference>& references() const { return references_; }
    /// In source order.
    const std::vector<Constant>& constants() const { return constants_; }
    const Symbols& symbols() const { return named_.symbols; }
    std::optional<LengthUnit> length_unit() const;

    /// The name at or directly before a place; null if there is none.
    const Reference* reference_at(std::uint32_t offset) const;
    const Token* token_at(std::uint32_t offset) const;
    const Definition* definition_of(const Reference& reference) const;
    const Definition* find(Kind kind, std::string_view name) const;
    /// Finds a register by a name of VAR_MOTOR or of the register map.
    const registers::Register* register_named(std::string_view name) const;
    /// The innermost STEP or POWER_UP around a place; null if there is none.
    const ast::Step* step_at(std::uint32_t offset) const;
    std::optional<std::uint8_t> number_of_step(std::string_view name) const;
    bool in_property(std::uint32_t offset) const;
    bool in_comment(std::uint32_t offset) const;
    std::string_view text(Span span) const {
        return std::string_view(sources_.text()).substr(span.offset, span.length);
    }
    std::uint32_t size() const { return own_file().length; }

  private:
    void define();
    Span declaration_of(Span name) const;
    Span block_of(Span name, std::string_view end_word) const;
    void resolve();
    std::size_t target_of(const ast::Use& use) const;
    void work_out_constants();
    void work_out(const ast::Value& value, const registers::Register* reg);
    void work_out(const std::vector<ast::Statement>& statements);

    Sources sources_;
    bool is_part_ = false;
    Lines lines_;
    std::vector<Diagnostic> grammar_;
    Report noise_;  ///< the compiler's own report, unused
    std::vector<Token> comments_;
    std::vector<Token> tokens_;
    ast::Program tree_;
    Compilation named_;  ///< result of name resolution only
    std::optional<Scope> scope_;
    std::vector<Definition> definitions_;
    std::unordered_multimap<std::string, std::size_t> by_name_;  ///< upper-case name to index in definitions_
    std::vector<Reference> references_;
    std::vector<Constant> constants_;
    mutable std::optional<Compilation> compiled_;
};

inline bool holds(Span span, std::uint32_t offset) {
    return offset >= span.offset && offset <= span.offset + span.length;
}
inline std::uint32_t end_of(Span span) {
    return span.offset + span.length;
}

}  // namespace nplc::seqc::analysis
