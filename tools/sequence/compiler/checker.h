#pragma once

#include "compiler/model.h"
#include "compiler/scope.h"
#include "diagnostics/report.h"
#include "language/ast.h"

namespace nplc::seqc {

/// Converts the program to mutually exclusive rules; reports surprising code.
Plan check(const ast::Program& program, Scope& scope, Report& report);

/// A step of a sequence without RETURN, and where its CALL would go on.
struct MissingReturn {
    ast::Name sequence;
    ast::Name back;
    std::uint8_t from = 0;
    std::uint8_t to = 0;
};
std::vector<MissingReturn> missing_returns(const ast::Program& program, const Scope& scope);

/// Warns about steps without a NEXT to them.
void warn_unreachable(const Plan& plan, const std::vector<MissingReturn>& missing, Report& report);

/// Tracks the motor's mode from step to step: reports orders that would start it towards an old target or not
/// at all, and waits for an INPOS that never comes.
void check_motor_state(const Plan& plan, const Symbols& symbols, std::string_view source, Report& report);

/// Checks a program's moves for a drive that the gateway translates for: ramps, which depend on velocity and
/// acceleration together and are added to `roundings`, and orders that wait for standstill. Set-points are
/// checked at both ends of their ranges.
void check_drive_motion(const Plan& plan, const registers::DriveModel& drive,
                        const std::vector<DeclaredSetPoint>& points, Report& report,
                        std::vector<Rounding>& roundings);

/// Reports registers that a program for such a drive selects but never writes: a JVL motor has their values
/// in its flash, the gateway starts with 0 and the drive's own values.
void check_drive_registers(const Plan& plan, const registers::DriveModel& drive, Report& report);

/// Checks the sum of roundings over relative moves.
void check_relative_moves(const Plan& plan, const std::vector<Rounding>& roundings, Report& report);

/// Reports moves that a later order of the same scan cancels.
void check_replaced_moves(const Plan& plan, Report& report);

/// True with INPOS only.
bool needs_in_position(const Rule& rule);
/// Whether a time or a count ends the step, independent of the motor.
bool has_time_limit(const StepPlan& step);

/// Reports HOME if HOME_MODE does not select a kind of homing for it.
void check_home_mode(const Plan& plan, registers::Model model, Report& report);

/// Reports moves that use the velocity, acceleration or torque selected for another move, on some paths to
/// their step.
void check_lasting_selections(const Plan& plan, const Symbols& symbols, std::string_view source,
                              Report& report);

/// Reports a fault step, or a step that a guard leads to, that is left without an operator's acknowledgement,
/// if the motor may move then; and a motor that moves at power-up.
void check_restart(const ast::Program& program, const Plan& plan, Scope& scope, Report& report);

/// Reports branches that continue with INPOS or at the end of the timer, without distinguishing them, and
/// time limits whose branches are exchanged.
void check_arrivals(const ast::Program& program, const Plan& plan, Report& report);

/// Reports waits for an INPOS that is already 1.
void check_standing_in_position(const Plan& plan, Report& report);

/// A STOP in a homing or a torque mode, another target in position mode, a speed that takes up a move again.
void check_lasting_motion(const Plan& plan, std::string_view source, Report& report);

/// Reports moves to where the axis stands, and time limits that end before the move can. Set-points count
/// with the ends of their ranges.
void check_known_places(const Plan& plan, const Symbols& symbols, const std::vector<DeclaredSetPoint>& points,
                        std::string_view source, Report& report);

/// Reports steps that a guard leads to while the motor may move, and that do not stop it.
void check_guards(const ast::Program& program, const Plan& plan, Scope& scope, Report& report);

/// Reports outputs that SET switched on, that a guard or an ERROR leaves on and that nothing resets then. The
/// plan is the one before make_copies.
void check_left_on(const ast::Program& program, const Plan& plan, const Symbols& symbols, Report& report);

/// Reports moves that begin at a P_SOLL or P_FNC that is not where the axis is.
void check_moved_away(const Plan& plan, Report& report);

/// Reports motor limits set by a program whose violation does not set ERROR (001 §5.2.1.6).
void check_invisible_limits(const Plan& plan, registers::Model model, Report& report);

/// Moves to a place with a velocity that is 0, or a set-point whose range holds 0.
void check_zero_speed(const Plan& plan, const Symbols& symbols, const std::vector<DeclaredSetPoint>& points,
                      Report& report);

/// Waits for COUNTER.Q on ways that preset the counter and never count down. Not for programs with TERMs.
void check_endless_counts(const Plan& plan, Report& report);

}  // namespace nplc::seqc
