#pragma once

#include <cstdlib>
#include <string>
#include <string_view>

#include "macreg/why.h"

/// What the parts of `why` share.
namespace nplc::macreg {

enum Mode : std::int64_t {
    kInit = 0,
    kVelocity = 1,
    kPosition = 2,
    kGearPosition = 3,
    kAnalogueTorque = 4,
    kAnalogueVelocity = 5,
    kAnalogueVelocityGear = 6,
    kBreak = 10,
    kStop = 11,
    kHome1 = 12,
    kHome2 = 13,
    kHome3 = 14,
    kSafe = 15,
    kAnalogueVelocityZero = 16,
    kVelocityAnalogueTorque = 17,
    kAnalogueGear = 18,
    kCoil = 19,
    kAnalogue2Position = 20,
    kAnaloguePosition = 21,
    kTestKi = 22,
    kTestTorque = 23,
    kGearFollow = 24,
};

/// A condition by name and number.
class Facts {
  public:
    explicit Facts(const Condition& condition) : condition_(condition) {}

    bool large() const { return condition_.model == registers::Model::mac800; }
    registers::Model model() const { return condition_.model; }
    std::int64_t at(std::uint8_t number) const { return condition_.now.at(number); }
    std::int64_t before(std::uint8_t number) const { return condition_.before.at(number); }
    /// By a name that both families have, or only this one.
    std::int64_t at(std::string_view name) const { return at(number(name)); }
    std::uint8_t number(std::string_view name) const {
        const registers::Register* reg = registers::find(condition_.model, name);
        return reg != nullptr ? reg->number : std::uint8_t{0};
    }
    bool knows(std::string_view name) const { return number(name) != 0; }
    std::int64_t mode() const { return at(registers::MODE_REG); }
    bool has_error(unsigned bit) const { return (at(registers::ERR_STAT) >> bit & 1) != 0; }
    const std::optional<GatewayState>& gateway() const { return condition_.gateway; }

    /// "1500 rpm", for a sentence.
    std::string text(std::uint8_t number) const;
    std::string text(std::string_view name) const { return text(number(name)); }

    /// MIN_P_IST and MAX_P_IST act.
    bool limited() const;
    /// P_MODE with this target ends inside of them (001 §4.4.3).
    bool allows(std::int64_t p_soll) const;
    /// A gateway's orders arrive, so FastMAC has the pins, whatever CNTRL_BITS has been set to since the last
    /// reset.
    bool speaks_fastmac() const;
    bool counts_pulses() const;
    bool moves() const;
    /// It turns much faster than its mode asks for, and is not slowing down.
    bool runs_away() const;
    bool is_passive() const { return mode() == kInit || mode() == kSafe; }
    /// "`macreg flash save --stop`": what wants a passive motor would be refused otherwise.
    std::string service(std::string_view command) const;
    bool homes() const { return mode() >= kHome1 && mode() <= kHome3; }
    bool gears() const;
    bool positions() const;
    bool has_velocity_limit() const;
    /// Of V_SOLL; what is slower looks like standing.
    std::int64_t tiny_velocity() const { return large() ? 14 : 10; }
    /// Both regulators are on.
    bool is_driven() const;
    /// 10 V at the analogue input.
    std::int64_t full_voltage() const { return large() ? 2047 : 1023; }
    /// That the mode allows, 1023 is full; AT_MODE and passive modes have none.
    std::int64_t torque_limit() const;

  private:
    const Condition& condition_;
};

using Findings = BasicFindings<std::uint8_t>;

void judge_limits(const Facts& facts, Findings& findings);  ///< of positions and FLWERR: why_limits.cpp
void judge_modes(const Facts& facts, Findings& findings);   ///< what each mode needs: why_modes.cpp
void judge_errors(const Facts& facts, Findings& findings);  ///< ERR_STAT and what leads to it: why_errors.cpp

/// What starts a passive motor without an error: P_MODE or V_MODE, to a place inside the position limits.
std::string start_words(const Facts& facts);
/// "`macreg set P_SOLL 4096`": another target that the position limits allow, in a register of targets.
std::string target_command(const Facts& facts, std::string_view name = "P_SOLL");
/// What has to come before a remedy that lets the motor turn, or it would leave the position limits. Empty:
/// nothing.
std::string before_it_turns(const Facts& facts);
/// How parameters come back that a file or the flash may still have.
std::string restore_words(const Facts& facts);
/// "clear it: `macreg set ERR_STAT none`, ...". ERR_STAT's settings stay.
std::string clear_words(const Facts& facts);
/// Back inside the position limits.
std::string way_back(const Facts& facts);

/// What to mend first in front.
void sort_by_rank(Findings& findings);
/// Remedies that let the motor turn say what has to come before.
void begin_safely(const Facts& facts, Findings& findings);
/// Behind a gateway, what it must be told before and what it does not carry.
void pass_gateway(const Facts& facts, Findings& findings);

}  // namespace nplc::macreg
