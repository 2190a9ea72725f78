#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "compiler/constants.h"
#include "compiler/model.h"
#include "diagnostics/report.h"
#include "language/ast.h"
#include "seqc/seqc.h"
#include "symbols/units.h"

namespace nplc::seqc {

/// A SET_POINT with the result of its checks.
struct DeclaredSetPoint {
    const ast::SetPoint* written = nullptr;
    set_points::SetPoint point;
    const registers::Register* reg = nullptr;  ///< of a motor's register
    bool is_decided = false;                   ///< its use is known
    bool is_sound = true;                      ///< no error was reported
};

/// The names of a program and its motor.
class Scope {
  public:
    Scope(const ast::Program& program, std::string_view source, Report& report, Compilation& result);

    Report& report() { return report_; }
    const Symbols& symbols() const { return result_.symbols; }
    /// In order of declaration.
    const std::vector<const ast::Step*>& steps() const { return steps_; }
    /// The number of `steps()[index]`; 62, which is no valid step, if there are too many.
    std::uint8_t number_of(std::size_t index) const { return numbers_[index]; }
    /// Null if no named step has this number.
    const ast::Step* step_numbered(std::uint8_t number) const;

    /// Number of a step by name; reports an unknown one.
    std::optional<std::uint8_t> step(const ast::Name& name, const std::vector<std::string_view>& groups = {});
    /// Bit number of an input 0..5 or an output 0..3, by its name or address.
    std::optional<std::size_t> input(const ast::Name& name);
    std::optional<std::size_t> output(const ast::Name& name);

    /// A register by a variable's or the manual's name, or by number; reports one that a table cannot write.
    const registers::Register* reg(const ast::Name& name);
    const registers::Register* reg(const ast::Value& number);
    /// The same without reports: to distinguish a register from a command.
    const registers::Register* find_register(std::string_view name) const;
    /// Adds the declaration of a register's name, if it is one of VAR_MOTOR.
    void note_declaration(Diagnostic& diagnostic, std::string_view name) const;
    /// Number of uses of names with a faulty declaration that was reported: these are not reported again.
    std::size_t faulty_names_met() const { return faulty_names_met_; }
    bool is_input(std::string_view name) const { return find(inputs_, name) != nullptr; }
    bool is_step(std::string_view name) const;
    /// Steps under one name, as a bit mask by number.
    void add_group(std::string_view name, std::uint64_t steps) {
        result_.symbols.groups.push_back({std::string(name), steps});
    }
    bool is_output(std::string_view name) const { return find(outputs_, name) != nullptr; }
    const ast::Constant* constant(std::string_view name) const { return constants_.find(name); }
    /// "a velocity", by the unit of a value; empty if the unit is not specific.
    std::string_view kind_of(const ast::Value& value) const;

    /// Evaluates a value with its names; reports errors. `reg`: the value's register.
    std::optional<ast::Value> worked_out(const ast::Value& value, const registers::Register* reg = nullptr);
    /// The bits to write, after unit, range and rounding; reports values that do not fit. `shown`: the
    /// program's name of the register.
    std::optional<std::uint32_t> value(const ast::Value& written, const registers::Register& reg,
                                       std::string_view shown);

    /// The number of the set-point in a value, 1 and on. The first use of one without AT determines its use.
    /// 0: an error was reported.
    bool is_set_point(const ast::Value& value) const;
    std::uint8_t set_point_for(const ast::Value& value, set_points::ValueKind kind,
                               const registers::Register* reg);
    const set_points::SetPoint& set_point(std::uint8_t number) const {
        return set_points_[number - 1U].point;
    }
    /// In order of declaration, unused ones included.
    const std::vector<DeclaredSetPoint>& set_points() const { return set_points_; }
    /// Reports a constant written to the register of a set-point.
    bool refuse_write(const registers::Register& reg, Span span);

    /// Reports orders that the drive does not support; true if none.
    bool is_for_drive(const Send& send);

    /// Register values of VAR_MOTOR, in order.
    const std::vector<Send>& initial_values() const { return initial_values_; }

    /// Sets the armed edges for R_TRIG and F_TRIG. Null: none allowed, and their use is reported.
    void see_edges(const std::vector<Edge>* edges, std::size_t armed) {
        edges_ = edges;
        armed_ = armed;
    }
    Truth truth_of(const ast::Expression& expression);
    /// The cases of a branch with this condition: without ERROR unless it names it.
    Truth branch_truth(const ast::Expression& condition);

  private:
    struct Variable {
        std::string_view name;
        Span span;
        std::size_t bit = 0;
        const registers::Register* reg = nullptr;
    };

    static const Variable* find(const std::vector<Variable>& variables, std::string_view name);
    Truth truth_of_edge(const ast::Expression& expression);
    void declare_motor(const ast::Program& program);
    void declare_scale(const ast::Program& program);
    void declare_steps(const ast::Program& program);
    void number_steps();
    std::optional<std::uint8_t> written_number(const ast::Step& step);
    void declare_io(const std::vector<ast::Variable>& declared, std::vector<Variable>& variables,
                    char direction, std::size_t count);
    void declare_constants(const ast::Program& program);
    void note_time(const ast::Constant& constant);
    void declare_value_of(const ast::Variable& variable, const registers::Register& reg, std::uint32_t bits);
    void declare_motor_variables(const ast::Program& program);
    void declare_set_points(const ast::Program& program);
    void declare_at(DeclaredSetPoint& declared, std::uint8_t number);
    std::optional<ast::SetPoint> worked_out(const ast::SetPoint& written, const registers::Register* reg);
    bool decide(DeclaredSetPoint& declared, set_points::ValueKind kind, const registers::Register* reg);
    bool is_for_drive_within(const ast::SetPoint& written, const registers::Register& reg, std::int32_t low,
                             std::int32_t high);
    bool decide_register(DeclaredSetPoint& declared, const registers::Register& reg);
    bool decide_preset(DeclaredSetPoint& declared);
    bool is_sound_range(DeclaredSetPoint& declared);
    bool is_default_on_grid(const DeclaredSetPoint& declared);
    bool is_new_name(const ast::Name& name);
    /// In the order of the program with its INCLUDEs.
    bool stands_before(Span a, Span b) const;
    std::string help_for_step(std::string_view name) const;
    bool is_faulty(std::string_view name);
    bool is_group(std::string_view name) const;
    void note_value(Diagnostic& diagnostic, const ast::Value& value, std::string_view shown) const;
    std::string unit_help(const registers::Register& reg, std::string_view unit) const;
    void report_no_value(const ast::Name& name, const registers::Register* reg);
    void report_no_register(const ast::Name& name);
    std::optional<std::size_t> signal(const ast::Name& name, const std::vector<Variable>& variables,
                                      char direction, std::size_t count);
    static std::string how_to_declare(std::string_view name, const std::vector<Variable>& variables,
                                      char direction, std::size_t count);
    bool is_reachable(const registers::Register* reg, Span span, std::string_view shown);
    void require_motor(Span span);
    bool note_rounding(const ast::Value& value, const registers::Register& reg, std::string_view shown_name,
                       double exact, double raw, double per_unit);
    bool takes_zero(const registers::Register& reg) const;
    void warn_without_unit(const ast::Value& value, const registers::Register& reg,
                           std::string_view shown_name, double raw);
    void note_drive_value(const ast::Value& value, const registers::Register& reg, std::string_view shown,
                          double exact, double per_unit, std::uint32_t bits);
    std::string motor_name() const;
    void report_refusal(const Send& send, std::string message);
    bool is_on_drive(const registers::Register& reg, Span span);
    std::string_view text(Span span) const { return source_.substr(span.offset, span.length); }

    std::string_view source_;
    Report& report_;
    Compilation& result_;
    registers::Model model_ = registers::Model::mac140;
    const registers::DriveModel* drive_ = nullptr;
    bool motor_known_ = false;
    Span motor_span_;
    std::optional<LengthUnit> length_;
    Span scale_span_;
    std::vector<const ast::Step*> steps_;
    std::unordered_map<std::string, std::size_t> step_places_;  ///< upper-case name to index in `steps_`
    std::vector<std::uint8_t> numbers_;
    bool steps_missing_ = false;
    bool names_missing_ = false;
    bool scale_missing_ = false;
    std::unordered_map<std::uint32_t, std::size_t> declared_;  ///< order of declarations, by offset
    std::vector<std::string_view> sequences_;
    std::vector<std::string_view> groups_;
    std::vector<Variable> inputs_;
    std::vector<Variable> outputs_;
    std::vector<Variable> motor_variables_;
    Constants constants_;
    std::unordered_set<std::string> without_unit_;  ///< registers already reported as values without a unit
    std::unordered_set<std::string> faulty_;        ///< declared with an error; upper case
    std::size_t faulty_names_met_ = 0;
    std::vector<Send> initial_values_;
    const std::vector<Edge>* edges_ = nullptr;
    std::size_t armed_ = 0;
    std::vector<DeclaredSetPoint> set_points_;
};

/// A number in a register's format.
std::uint32_t bits_of(std::int32_t number, const registers::Register& reg);

/// The number that raw bits represent in a register.
double number_of_bits(double bits, registers::Format format);

/// Whether a condition names ERROR or ANY ERROR; otherwise it implies NOT ERROR.
bool names_error(const ast::Expression& expression);

}  // namespace nplc::seqc
