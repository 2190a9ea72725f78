#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "compiler/chosen_motor.h"
#include "compiler/name_table.h"
#include "compiler/register_values.h"
#include "diagnostics/report.h"
#include "language/ast.h"
#include "seqc/seqc.h"

namespace nplc::seqc {

/// A SET_POINT with the result of its checks.
struct DeclaredSetPoint {
    const ast::SetPoint* written = nullptr;
    set_points::SetPoint point;
    const registers::Register* reg = nullptr;  ///< of a motor's register
    bool is_decided = false;                   ///< its use is known
    bool is_sound = true;                      ///< no error was reported
};

/// The set-points of a program. The first use of one without AT determines what it is for.
class SetPointTable {
  public:
    SetPointTable(std::string_view source, Report& report, Compilation& result, ChosenMotor& motor,
                  NameTable& names, RegisterValues& values)
        : source_(source), report_(report), result_(result), motor_(motor), names_(names), values_(values) {}

    void declare(const ast::Program& program);
    /// In order of declaration, unused ones included.
    const std::vector<DeclaredSetPoint>& all() const { return set_points_; }
    bool names_one(const ast::Value& value) const;
    /// The number of the set-point in a value, 1 and on; 0: an error was reported.
    std::uint8_t number_for(const ast::Value& value, set_points::ValueKind kind,
                            const registers::Register* reg);
    /// Reports a constant written to the register of a set-point.
    bool refuse_write(const registers::Register& reg, Span span);

  private:
    void declare_at(DeclaredSetPoint& declared, std::uint8_t number);
    std::optional<ast::SetPoint> worked_out(const ast::SetPoint& written, const registers::Register* reg);
    bool decide(DeclaredSetPoint& declared, set_points::ValueKind kind, const registers::Register* reg);
    bool decide_register(DeclaredSetPoint& declared, const registers::Register& reg);
    bool decide_preset(DeclaredSetPoint& declared);
    bool is_for_drive_within(const ast::SetPoint& written, const registers::Register& reg, std::int32_t low,
                             std::int32_t high);
    bool is_sound_range(DeclaredSetPoint& declared);
    std::string_view text(Span span) const { return source_.substr(span.offset, span.length); }

    std::string_view source_;
    Report& report_;
    Compilation& result_;
    ChosenMotor& motor_;
    NameTable& names_;
    RegisterValues& values_;
    std::vector<DeclaredSetPoint> set_points_;
};

}  // namespace nplc::seqc
