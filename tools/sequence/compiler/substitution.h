#pragma once

#include <deque>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "language/ast.h"

namespace nplc::seqc {

/// Replaces a sequence's parameters by arguments, and its step names by those in the program.
class Substitution {
  public:
    /// As many arguments as parameters; their data and `texts` must stay valid.
    Substitution(const std::vector<ast::Parameter>& parameters, const std::vector<ast::Argument>& arguments,
                 std::deque<std::string>& texts);

    void rename(std::string_view step, std::string_view name);
    void go_back_to(const ast::Name& step) { back_ = step; }

    void apply(ast::Step& step) const;

  private:
    void apply(std::vector<ast::Statement>& statements) const;
    void apply(ast::Statement& statement) const;
    void apply(ast::Expression& expression) const;
    void apply(ast::Value& value) const;
    void apply(std::vector<ast::Name>& names) const;
    void apply(ast::Name& name) const;
    void apply_to_step(ast::Name& name) const;
    const ast::Argument* argument_for(std::string_view name) const;

    std::map<std::string, const ast::Argument*> arguments_;  ///< by the parameter's name in capitals
    std::map<std::string, std::string_view> steps_;
    ast::Name back_;
    std::deque<std::string>& texts_;
};

}  // namespace nplc::seqc
