#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/chosen_motor.h"
#include "compiler/model.h"
#include "compiler/name_table.h"
#include "compiler/register_values.h"
#include "compiler/set_point_table.h"
#include "compiler/signals.h"
#include "compiler/step_names.h"
#include "diagnostics/report.h"
#include "language/ast.h"
#include "seqc/seqc.h"

namespace nplc::seqc {

/// The names of a program and its motor, each kind in a part of its own.
class Scope {
  public:
    Scope(const ast::Program& program, std::string_view source, Report& report, Compilation& result);
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

    Report& report() { return report_; }
    const Symbols& symbols() const { return result_.symbols; }
    /// In order of declaration.
    const std::vector<const ast::Step*>& steps() const { return steps_.all(); }
    /// The number of `steps()[index]`; 62, which is no valid step, if there are too many.
    std::uint8_t number_of(std::size_t index) const { return steps_.number_at(index); }
    /// Null if no named step has this number.
    const ast::Step* step_numbered(std::uint8_t number) const { return steps_.numbered(number); }

    /// Null if there is none.
    const ast::Step* step_named(std::string_view name) const { return steps_.named(name); }

    /// Number of a step by name; reports an unknown one.
    std::optional<std::uint8_t> step(const ast::Name& name,
                                     const std::vector<std::string_view>& groups = {}) {
        return steps_.number_of(name, groups);
    }
    /// An input, or the bit number of an output 0..3, by its name or address.
    std::optional<InputTest> input(const ast::Name& name) { return signals_.input(name); }
    std::optional<std::size_t> output(const ast::Name& name) { return signals_.output(name); }

    /// A register by a variable's or the manual's name, or by number; reports one that a table cannot write.
    const registers::Register* reg(const ast::Name& name) { return values_.named(name); }
    const registers::Register* reg(const ast::Value& number) { return values_.numbered(number); }
    /// The same without reports: to distinguish a register from a command.
    const registers::Register* find_register(std::string_view name) const { return values_.find(name); }
    /// Adds the declaration of a register's name, if it is one of VAR_MOTOR.
    void note_declaration(Diagnostic& diagnostic, std::string_view name) const {
        names_.note_declaration(diagnostic, name);
    }
    /// Number of uses of names with a faulty declaration that was reported: these are not reported again.
    std::size_t faulty_names_met() const { return names_.faulty_met(); }
    bool is_input(std::string_view name) const { return names_.is_input(name); }
    bool is_step(std::string_view name) const { return steps_.has(name); }
    /// Steps under one name, as a bit mask by number.
    void add_group(std::string_view name, std::uint64_t steps) {
        result_.symbols.groups.push_back({std::string(name), steps});
    }
    bool is_output(std::string_view name) const { return names_.is_output(name); }
    const ast::Constant* constant(std::string_view name) const { return names_.constants().find(name); }
    /// "a velocity", by the unit of a value; empty if the unit is not specific.
    std::string_view kind_of(const ast::Value& value) const { return values_.kind_of(value); }

    /// Evaluates a value with its names; reports errors. `reg`: the value's register.
    std::optional<ast::Value> worked_out(const ast::Value& value, const registers::Register* reg = nullptr) {
        return values_.worked_out(value, reg);
    }
    /// The bits to write, after unit, range and rounding; reports values that do not fit. `shown`: the
    /// program's name of the register.
    std::optional<std::uint32_t> value(const ast::Value& written, const registers::Register& reg,
                                       std::string_view shown) {
        return values_.written_bits(written, reg, shown);
    }

    /// The number of the set-point in a value, 1 and on. The first use of one without AT determines its use.
    /// 0: an error was reported.
    bool is_set_point(const ast::Value& value) const { return set_points_.names_one(value); }
    std::uint8_t set_point_for(const ast::Value& value, set_points::ValueKind kind,
                               const registers::Register* reg) {
        return set_points_.number_for(value, kind, reg);
    }
    const set_points::SetPoint& set_point(std::uint8_t number) const {
        return set_points_.all()[number - 1U].point;
    }
    /// In order of declaration, unused ones included.
    const std::vector<DeclaredSetPoint>& set_points() const { return set_points_.all(); }
    /// Reports a constant written to the register of a set-point.
    bool refuse_write(const registers::Register& reg, Span span) {
        return set_points_.refuse_write(reg, span);
    }

    /// Reports orders that the drive does not support; true if none.
    bool is_for_drive(const Send& send) { return motor_.is_for_drive(send); }

    /// Register values of VAR_MOTOR, in order.
    const std::vector<Send>& initial_values() const { return values_.initial(); }

    /// Sets the armed edges for R_TRIG and F_TRIG. Null: none allowed, and their use is reported.
    void see_edges(const std::vector<Edge>* edges, std::size_t armed) {
        edges_ = edges;
        armed_ = armed;
    }
    Truth truth_of(const ast::Expression& expression);
    /// The cases of a branch with this condition: without ERROR unless it names it.
    Truth branch_truth(const ast::Expression& condition);

  private:
    Truth truth_of_edge(const ast::Expression& expression);

    Report& report_;
    Compilation& result_;
    ChosenMotor motor_;
    NameTable names_;
    Signals signals_;
    StepNames steps_;
    RegisterValues values_;
    SetPointTable set_points_;
    const std::vector<Edge>* edges_ = nullptr;
    std::size_t armed_ = 0;
};

/// Whether a condition names ERROR or ANY ERROR; otherwise it implies NOT ERROR.
bool names_error(const ast::Expression& expression);

}  // namespace nplc::seqc
