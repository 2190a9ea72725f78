#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "diagnostics/report.h"
#include "language/ast.h"
#include "registers/mac.h"

namespace nplc::seqc {

/// CONST declarations, and the arithmetic of values.
class Constants {
  public:
    explicit Constants(Report& report) : report_(report) {}

    /// Evaluates the constant; reports errors. It may use those declared before. False if it has no value.
    bool declare(const ast::Constant& constant);
    bool is_empty() const { return constants_.empty(); }
    /// The actual value of a name of VAR_MOTOR. It can be used while name_registers() is on.
    void declare_register(const ast::Name& name, const ast::Value& value);
    void name_registers(bool on) { names_registers_ = on; }
    /// Positions of the register values used by the last value.
    const std::vector<Span>& registers_met() const { return registers_met_; }
    const ast::Constant* find(std::string_view name) const;
    std::vector<std::string_view> names() const;

    /// Evaluates to one literal with the span of the whole value. `reg`: the register whose modes and bits
    /// may be named; null if none. Empty after a reported error, or if a name is unknown, which is then in
    /// `unknown`.
    std::optional<ast::Value> worked_out(const ast::Value& value, const registers::Register* reg,
                                         registers::Model model);
    /// The undefined name found by the last call; null: none.
    const ast::Name* unknown() const { return unknown_; }

  private:
    using Result = std::optional<ast::Value>;

    Result evaluate(const ast::Value& value);
    Result literal(const ast::Value& value);
    Result named(const ast::Value& value);
    Result part(const ast::Value& value);
    Result bits(const ast::Value& value, std::optional<std::uint32_t> found);
    Result sum(const ast::Value& value);
    Result product(const ast::Value& value);
    Result added(ast::Value left, const ast::Value& right);
    Result multiplied(ast::Value left, const ast::Value& right);
    Result divided(ast::Value left, const ast::Value& right);
    std::nullopt_t refuse(Span span, std::string message, std::string help);

    Report& report_;
    std::vector<ast::Constant> constants_;
    std::unordered_map<std::string, std::size_t> places_;  ///< by upper-case name
    std::vector<ast::Constant> registers_;
    std::vector<Span> registers_met_;
    bool names_registers_ = false;
    const registers::Register* reg_ = nullptr;
    registers::Model model_ = registers::Model::mac140;
    const ast::Name* unknown_ = nullptr;
};

}  // namespace nplc::seqc
