#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "compiler/chosen_motor.h"
#include "compiler/model.h"
#include "compiler/name_table.h"
#include "compiler/step_names.h"
#include "diagnostics/report.h"
#include "language/ast.h"
#include "seqc/seqc.h"

namespace nplc::seqc {

/// The motor's registers by name and number, and the values that are written to them.
class RegisterValues {
  public:
    RegisterValues(std::string_view source, Report& report, Compilation& result, ChosenMotor& motor,
                   NameTable& names, const StepNames& steps)
        : source_(source), report_(report), result_(result), motor_(motor), names_(names), steps_(steps) {}

    /// VAR_MOTOR.
    void declare_variables(const ast::Program& program);
    /// Values to be written at POWER_UP, in order.
    const std::vector<Send>& initial() const { return initial_; }
    void add_initial(const Send& send) { initial_.push_back(send); }

    /// By a variable's or the manual's name; null without a report.
    const registers::Register* find(std::string_view name) const;
    /// The same; reports one that a table cannot write.
    const registers::Register* named(const ast::Name& name);
    const registers::Register* numbered(const ast::Value& number);

    /// Evaluates a value with its names; reports errors. `reg`: the value's register.
    std::optional<ast::Value> worked_out(const ast::Value& value, const registers::Register* reg);
    /// The bits to write, after unit, range and rounding; reports values that do not fit. `shown`: the
    /// program's name of the register.
    std::optional<std::uint32_t> written_bits(const ast::Value& written, const registers::Register& reg,
                                              std::string_view shown);
    /// "a velocity", by the unit of a value; empty if the unit is not specific.
    std::string_view kind_of(const ast::Value& value) const;

  private:
    void declare_value_of(const ast::Variable& variable, const registers::Register& reg, std::uint32_t bits);
    bool is_set_point(std::string_view name) const;
    void report_no_register(const ast::Name& name);
    void report_no_value(const ast::Name& name, const registers::Register* reg);
    void note_value(Diagnostic& diagnostic, const ast::Value& value, std::string_view shown) const;
    std::string unit_help(const registers::Register& reg, double number, std::string_view unit) const;
    void warn_without_unit(const ast::Value& value, const registers::Register& reg,
                           std::string_view shown_name, double raw);
    bool note_rounding(const ast::Value& value, const registers::Register& reg, std::string_view shown_name,
                       double exact, double raw, double per_unit);
    void note_drive_value(const ast::Value& value, const registers::Register& reg,
                          std::string_view shown_name, double exact, double per_unit, std::uint32_t bits);
    std::string_view text(Span span) const { return source_.substr(span.offset, span.length); }

    std::string_view source_;
    Report& report_;
    Compilation& result_;
    ChosenMotor& motor_;
    NameTable& names_;
    const StepNames& steps_;
    std::unordered_set<std::string> without_unit_;  ///< registers already reported as values without a unit
    std::vector<Send> initial_;
};

/// A number in a register's format.
std::uint32_t bits_of(std::int32_t number, const registers::Register& reg);

/// The number that raw bits represent in a register.
double number_of_bits(double bits, registers::Format format);

}  // namespace nplc::seqc
