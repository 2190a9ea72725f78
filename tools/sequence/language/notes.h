#pragma once

#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "language/ast.h"
#include "language/token_stream.h"

namespace nplc::seqc {

/// What is noted beside the tree while a program is parsed, and what is known of its names by then.
class Notes {
  public:
    explicit Notes(TokenStream& in) : in_(in) {}

    /// Takes a name and notes its use. `what` stands in the message if there is none.
    bool expect_name(ast::Name& name, std::string_view what, ast::Role role, bool declares = false);
    void add_use(ast::Role role, Span span, bool declares = false) {
        uses_.push_back({role, span, declares});
    }
    /// What the last name turned out to be.
    void set_last_role(ast::Role role) { uses_.back().role = role; }

    /// Takes the word that ends a block, or reports that it is missing; whether the block is closed.
    bool end_block(std::string_view end_word, Span opened);

    /// Until its end, a declaration's name counts as one with an error.
    void begin_declaration(std::string_view name) { faulty_names_.push_back(name); }
    void end_declaration() { faulty_names_.pop_back(); }
    /// Some names could not be parsed.
    void miss_names() { names_missing_ = true; }

    void add_register(std::string_view name) { registers_.push_back(name); }
    bool is_register(std::string_view name) const;
    void add_sequence(std::string_view name) { sequences_.push_back(name); }
    bool is_sequence(std::string_view name) const;
    void note_call() { has_calls_ = true; }

    /// Keeps a text that stands in no source.
    std::string_view keep(std::string text) { return texts_.emplace_back(std::move(text)); }

    /// Adds all of it to the tree.
    void hand_over(ast::Program& program);

  private:
    TokenStream& in_;
    std::deque<std::string> texts_;
    std::vector<ast::Use> uses_;
    std::vector<ast::Block> blocks_;
    std::vector<std::string_view> faulty_names_;
    std::vector<std::string_view> registers_;  ///< of VAR_MOTOR
    std::vector<std::string_view> sequences_;  ///< declared so far
    bool names_missing_ = false;
    bool has_calls_ = false;
};

}  // namespace nplc::seqc
