#pragma once

#include "diagnostics/report.h"
#include "semantics/model.h"
#include "semantics/scope.h"
#include "syntax/ast.h"

namespace nplc::seqc {

/// From the program as written to rules that never hold together; reports what would surprise.
Plan check(const ast::Program& program, Scope& scope, Report& report);

/// Steps that no NEXT leads to.
void warn_unreachable(const Plan& plan, Report& report);

/// Follows the motor's mode from step to step: what would start it towards an old target, or not at all, and
/// what waits for an INPOS that never comes.
void check_motor_state(const Plan& plan, const Symbols& symbols, std::string_view source, Report& report);

/// What a drive that the gateway translates for makes of a program's moves: ramps, which depend on velocity
/// and acceleration together and go into `roundings`, and orders that wait until it stands.
/// Set-points count with both ends of their ranges.
void check_drive_motion(const Plan& plan, const registers::DriveModel& drive,
                        const std::vector<DeclaredSetPoint>& points, Report& report,
                        std::vector<Rounding>& roundings);

/// Registers that a program for such a drive selects and never gives a value: a JVL motor has them in its
/// flash, the gateway begins with 0 and with the drive's own.
void check_drive_registers(const Plan& plan, const registers::DriveModel& drive, Report& report);

/// Distances that were rounded and that relative moves add up.
void check_relative_moves(const Plan& plan, const std::vector<Rounding>& roundings, Report& report);

/// Moves that a later order of the same scan makes void.
void check_replaced_moves(const Plan& plan, Report& report);

/// It holds with INPOS only.
bool needs_in_position(const Rule& rule);
/// Whether the step ends by a time or a count, whatever the motor does.
bool has_time_limit(const StepPlan& step);

/// HOME where HOME_MODE has no kind of homing for it.
void check_home_mode(const Plan& plan, registers::Model model, Report& report);

/// Moves that take the velocity, acceleration or torque of another move, on some ways into their step.
void check_lasting_selections(const Plan& plan, const Symbols& symbols, std::string_view source,
                              Report& report);

/// A fault step, or a step that a guard leads to, that is left without asking a person, where the motor may
/// move then; and moves at power-up.
void check_restart(const ast::Program& program, const Plan& plan, Scope& scope, Report& report);

/// Branches that go on with INPOS or when the timer has run down, whichever it was, and time limits whose
/// branches are exchanged.
void check_arrivals(const ast::Program& program, const Plan& plan, Report& report);

/// Waits for an INPOS that stands already.
void check_standing_in_position(const Plan& plan, Report& report);

/// Moves to where the axis stands, and time limits that end before the move can. Set-points count with the
/// ends of their ranges.
void check_known_places(const Plan& plan, const Symbols& symbols, const std::vector<DeclaredSetPoint>& points,
                        std::string_view source, Report& report);

/// Steps that a guard leads to while the motor may move, and that do not stop it.
void check_guards(const ast::Program& program, const Plan& plan, Scope& scope, Report& report);

/// Outputs that SET switched on, that a guard or an ERROR leaves on and that nothing resets then. The plan is
/// the one before make_copies.
void check_left_on(const ast::Program& program, const Plan& plan, const Symbols& symbols, Report& report);

/// Moves that begin at a P_SOLL or P_FNC that is not where the axis is.
void check_moved_away(const Plan& plan, Report& report);

/// Limits of the motor that a program sets, although reaching them does not show in ERROR (001 §5.2.1.6).
void check_invisible_limits(const Plan& plan, registers::Model model, Report& report);

}  // namespace nplc::seqc
