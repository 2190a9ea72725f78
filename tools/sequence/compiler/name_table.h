#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "compiler/chosen_motor.h"
#include "compiler/constants.h"
#include "diagnostics/report.h"
#include "language/ast.h"
#include "seqc/seqc.h"

namespace nplc::seqc {

/// A name of VAR_INPUT, VAR_OUTPUT, VAR_MOTOR, or of a set-point with AT.
struct DeclaredName {
    std::string_view name;
    Span span;
    std::size_t bit = 0;                       ///< of an input or output
    const registers::Register* reg = nullptr;  ///< of the motor's
    bool is_inverted = false;                  ///< of an input: holds while its wire is off
};

/// Null if there is none.
const DeclaredName* find_name(const std::vector<DeclaredName>& names, std::string_view name);

/// IN0, %IX0.0 and the like: the number in the address, or empty if it is no address. `direction`: I or Q.
std::optional<std::size_t> address_number(std::string_view text, char direction);

/// The names of signals, registers and constants, each declared once.
class NameTable {
  public:
    NameTable(const ast::Program& program, const ChosenMotor& motor, Report& report);

    std::vector<DeclaredName>& inputs() { return inputs_; }
    std::vector<DeclaredName>& outputs() { return outputs_; }
    std::vector<DeclaredName>& registers() { return registers_; }
    Constants& constants() { return constants_; }
    const Constants& constants() const { return constants_; }
    void declare_constants(const ast::Program& program, Symbols& symbols);

    /// Reports a name that has a meaning already.
    bool is_new(const ast::Name& name);
    bool is_input(std::string_view name) const { return find_name(inputs_, name) != nullptr; }
    bool is_output(std::string_view name) const { return find_name(outputs_, name) != nullptr; }
    const DeclaredName* find_register(std::string_view name) const { return find_name(registers_, name); }
    /// Adds the declaration of a register's name, if it is one of VAR_MOTOR.
    void note_declaration(Diagnostic& diagnostic, std::string_view name) const;
    /// Of the set-points, in order of declaration.
    std::vector<std::string_view>& set_points() { return set_points_; }

    void add_faulty(std::string_view name);
    /// Whether an error in the name's declaration was reported; its use is then counted as one.
    bool is_faulty(std::string_view name);
    void meet_faulty() { ++faulty_met_; }
    std::size_t faulty_met() const { return faulty_met_; }

  private:
    /// In the order of the program with its INCLUDEs.
    bool stands_before(Span a, Span b) const;

    const ChosenMotor& motor_;
    Report& report_;
    std::unordered_map<std::uint32_t, std::size_t> declared_;  ///< order of declarations, by offset
    std::vector<DeclaredName> inputs_;
    std::vector<DeclaredName> outputs_;
    std::vector<DeclaredName> registers_;
    Constants constants_;
    std::vector<std::string_view> set_points_;
    std::unordered_set<std::string> faulty_;  ///< declared with an error; upper case
    std::size_t faulty_met_ = 0;
    bool names_missing_ = false;
};

}  // namespace nplc::seqc
