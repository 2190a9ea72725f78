#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "compiler/model.h"
#include "diagnostics/report.h"
#include "language/ast.h"
#include "seqc/seqc.h"
#include "symbols/units.h"

namespace nplc::seqc {

/// What MOTOR and SCALE say, and what the drive behind the gateway can do, if there is one.
class ChosenMotor {
  public:
    ChosenMotor(std::string_view source, Report& report, Compilation& result)
        : source_(source), report_(report), result_(result) {}

    void declare(const ast::Program& program);

    registers::Model model() const { return model_; }
    /// Null: the motor speaks the gateway's language itself.
    const registers::DriveModel* drive() const { return drive_; }
    /// Named, or reported as missing.
    bool is_known() const { return is_known_; }
    Span span() const { return span_; }
    /// For messages: "MAC140".
    std::string name() const;
    /// Reports a program without MOTOR, once.
    void require(Span span);

    /// The unit of SCALE.
    const std::optional<LengthUnit>& length() const { return length_; }
    Span scale_span() const { return scale_span_; }
    /// SCALE could not be parsed: an unknown unit may be its own.
    bool scale_is_missing() const { return scale_missing_; }
    /// What one of `unit` is in the register; empty if it does not fit.
    std::optional<double> per_unit(const registers::Register& reg, std::string_view unit) const {
        return raw_per_unit(reg, model_, length_, unit);
    }

    /// Reports orders that the drive does not support; true if none.
    bool is_for_drive(const Send& send);
    /// The same with a message of one's own, for an order that the drive refuses.
    void report_refusal(const Send& send, std::string message);
    /// Whether the drive has the register at all, for any value.
    bool is_on_drive(const registers::Register& reg, Span span);
    bool takes_zero(const registers::Register& reg) const;

  private:
    void declare_motor(const ast::Program& program);
    void declare_scale(const ast::Program& program);

    std::string_view source_;
    Report& report_;
    Compilation& result_;
    registers::Model model_ = registers::Model::mac140;
    const registers::DriveModel* drive_ = nullptr;
    bool is_known_ = false;
    Span span_;
    std::optional<LengthUnit> length_;
    Span scale_span_;
    bool scale_missing_ = false;
};

}  // namespace nplc::seqc
