#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "sim/condition.h"
#include "sim/snapshot.h"

namespace nplc::sim {

namespace action {

struct SetInput {
    unsigned index = 0;
    bool level = false;
};
/// Drops actions that rules have planned before.
struct Cancel {
    enum class What : std::uint8_t { input, motor, line, gateway, log, end, all };
    What what = What::all;  ///< all except end
    unsigned index = 0;     ///< of the input
};
struct ToggleInput {
    unsigned index = 0;
};
struct CutLine {
    bool cut = true;
};
/// Sets the named shares and keeps the others.
struct SpoilLine {
    bool to_motor = true;
    bool from_motor = true;
    std::optional<double> drop;
    std::optional<double> damage;
    std::optional<double> framing;
    std::optional<double> delay;
    std::optional<Time> longest_delay;
    std::optional<Time> late{};
    std::optional<Time> together{};
};
struct Seed {
    std::uint64_t value = 1;
};
struct FailMotor {};  ///< the drive reports a follow error
struct PowerMotor {
    bool on = true;
};
struct LoadMotor {
    int torque = 0;  ///< constant load torque on the shaft, 1023 = the motor's full torque
};
struct MotorBrake {
    int torque = 0;  ///< holding torque of a MAC800's brake; 0: none is built in
};
/// Mechanical ends of the axis, in counts from the shaft's initial position.
struct StopMotor {
    bool above = true;  ///< else below
    std::int64_t counts = 0;
    double torque_per_count = 0;  ///< restoring torque; 0: rigid
};
struct FreeMotor {};  ///< no mechanical ends
/// A sensor on the analogue input: 10 V on one side of a position, 0 V on the other.
struct MotorSensor {
    bool on_above = true;  ///< else below
    std::int64_t counts = 0;
};
/// An input of a MIDI module.
enum class DriveInput : std::uint8_t { upper_stop, lower_stop, reference, security };
struct SetDriveInput {
    DriveInput input = DriveInput::upper_stop;
    bool active = false;
};
/// A switch at the input: active on one side of a position.
struct DriveSwitch {
    DriveInput input = DriveInput::upper_stop;
    bool on_above = true;  ///< else below
    std::int64_t counts = 0;
};
struct MotorAnalogue {
    double volts = 0;
};
struct MotorPulses {
    int per_second = 0;
    bool with_direction = false;  ///< pulse and direction, else quadrature
};
struct MotorSupply {
    double volts = 0;
    bool logic = false;  ///< the control supply of a MAC800, else the motor's own
};
struct MotorTemperature {
    int celsius = 0;  ///< ambient temperature of a MAC800
};
struct BreakEncoder {};  ///< of a MAC800, until its power is switched off
enum class Gateway : std::uint8_t { stop, run, restart, safe, hold, step, scan };
/// Breakpoints in place of those that were there. Bit n: step n.
struct Breakpoints {
    std::uint64_t steps = 0;
};
/// Forces on the signals of `mask`, until they are released or the gateway ends all forces.
struct ForceSignals {
    bool outputs = false;  ///< else inputs
    std::uint8_t mask = 0;
    std::uint8_t levels = 0;
    bool releases = false;  ///< no longer forced
};
/// A request to the gateway's set-points, as written to SET_POINT_WRITE.
struct SetPoints {
    std::vector<std::uint8_t> request;
    std::string text;  ///< as written in the scenario
};
struct Log {
    std::string text;
};
struct End {};

/// Actions on the motor's shaft, terminals and environment.
using OnMotor =
    std::variant<LoadMotor, MotorBrake, StopMotor, FreeMotor, MotorSensor, SetDriveInput, DriveSwitch,
                 MotorAnalogue, MotorPulses, MotorSupply, MotorTemperature, BreakEncoder>;

}  // namespace action

struct Action {
    Time after{0};  ///< delay after the event that triggered it
    std::variant<action::SetInput, action::ToggleInput, action::Cancel, action::CutLine, action::SpoilLine,
                 action::Seed, action::FailMotor, action::PowerMotor, action::LoadMotor, action::MotorBrake,
                 action::StopMotor, action::FreeMotor, action::MotorSensor, action::SetDriveInput,
                 action::DriveSwitch, action::MotorAnalogue, action::MotorPulses, action::MotorSupply,
                 action::MotorTemperature, action::BreakEncoder, action::Gateway, action::Breakpoints,
                 action::ForceSignals, action::SetPoints, action::Log, action::End>
        what;
    bool takes_back = false;  ///< what the action before it did
};
using Actions = std::vector<Action>;

struct AtRule {
    Time time{0};
    Actions actions;
    int line = 0;
};
struct EveryRule {
    Time period{0};
    Time from{0};
    std::optional<Time> until;
    Actions actions;
    int line = 0;
};
struct WhenRule {
    Event event;
    bool once = false;
    std::uint64_t times = 1;  ///< required number of events
    Time from{0};             ///< events before it, or after `until`, are ignored
    std::optional<Time> until;
    Actions actions;
    int line = 0;
};
/// An input that follows a condition of the machine with a delay; shorter changes do not show.
struct FollowRule {
    unsigned input = 0;
    Condition condition;
    Time after{0};
    Time back{0};  ///< delay when the condition becomes false
    int line = 0;
    bool inverted = false;  ///< its terminal is off while the condition holds
};

struct Expectation {
    enum class Kind : std::uint8_t {
        at,      ///< the condition holds at `time`; at the end without one
        by,      ///< it holds at least once until `time`, or the end
        always,  ///< it holds from `from` until `time`, or the end
        within,  ///< it holds at least once within `span` after each event
        after,   ///< it holds `span` after each event
        during,  ///< it holds all the `span` after each event
        count,   ///< the event happens `least` to `most` times until `time`, or the end
    };
    Kind kind = Kind::at;
    int line = 0;
    std::string text;  ///< as written in the scenario
    Condition condition;
    Event event;
    std::optional<Time> time;
    Time from{0};  ///< for `always` and events: start of the observation
    Time span{0};
    Time hold{0};  ///< the condition counts as true only after it was true for this time
    std::uint64_t least = 1;
    std::uint64_t most = UINT64_MAX;
};

/// A register in the motor's flash at power-on; for a MIDI module a parameter by its command's number.
struct StoredRegister {
    std::uint8_t number = 0;
    std::uint32_t bits = 0;
};

/// A plant file named in the scenario.
struct NamedPlant {
    std::string file;  ///< as written there
    int line = 0;
};

struct Scenario {
    std::string file;
    std::optional<NamedPlant> plant;
    std::vector<StoredRegister> registers;
    std::vector<AtRule> at;
    std::vector<EveryRule> every;
    std::vector<WhenRule> when;
    std::vector<FollowRule> follow;
    std::vector<Expectation> expectations;
    std::vector<std::string> recipes;  ///< that it saves
    std::optional<Time> end;

    bool can_end() const;  ///< has an end, or a rule with the action `end`
};

struct Mistake {
    int line = 0;
    int column = 0;       ///< 0: the whole line
    std::string message;  ///< the error and its remedy

    std::string place() const;  ///< `12:5`
};

struct ParsedScenario {
    Scenario scenario;
    std::vector<Mistake> mistakes;  ///< the first 1000; the scenario is valid only without any
};

/// One line each, the first twenty, and the number of further ones.
std::string in_words(const std::string& file, const std::vector<Mistake>& mistakes);

/// The language: this folder's README. `file` is for messages only.
ParsedScenario parse_scenario(std::string_view text, const std::string& file, const Names& names);

/// Immediate input: actions, without a time, a rule or an expectation.
struct ParsedActions {
    Actions actions{};
    std::string mistake{};  ///< empty: none
};
ParsedActions parse_actions(std::string_view line, const Names& names);

}  // namespace nplc::sim
