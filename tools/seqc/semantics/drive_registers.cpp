// Checks a program for a drive without registers: registers that are selected but never written.
#include <fmt/format.h>

#include <set>
#include <string>

#include "semantics/checker.h"
#include "semantics/commands.h"
#include "semantics/motors.h"

namespace nplc::seqc {
namespace {

using protocol::fastmac::Group;
using protocol::fastmac::Number;

std::uint8_t register_of(Group group, unsigned index) {
    switch (group) {
        case Group::p:
            return static_cast<std::uint8_t>(registers::P1 + 2 * (index - 1));
        case Group::v:
            return static_cast<std::uint8_t>(registers::V1 + index - 1);
        case Group::a:
            return static_cast<std::uint8_t>(registers::A1 + index - 1);
        case Group::t:
            return static_cast<std::uint8_t>(registers::T1 + index - 1);
        case Group::l:
            return static_cast<std::uint8_t>(registers::L1 + index - 1);
        case Group::z:
            break;
    }
    return static_cast<std::uint8_t>(registers::Z1 + index - 1);
}

class UnsetRegisters {
  public:
    UnsetRegisters(const Plan& plan, const registers::DriveModel& drive, Report& report)
        : plan_(plan), drive_(drive), report_(report) {
        for (const RawTerm& term : plan.terms) take(term);
        for (const StepPlan& step : plan.steps) {
            for (const RawTerm& term : step.terms) take(term);
        }
        for_each_send(plan, [this](const Send& send) {
            if (send.reg != nullptr) given_.insert(send.reg->number);
        });
    }

    void run() {
        for_each_send(plan_, [this](const Send& send) { judge(send); });
    }

  private:
    void take(const RawTerm& term) {
        const sequencer::Term decoded = sequencer::decode(term.bytes);
        if (!decoded.is_flex) return;
        given_.insert(decoded.flex.reg);
        if (decoded.flex.longword) given_.insert(static_cast<std::uint8_t>(decoded.flex.reg + 1));
    }

    void judge(const Send& send) {
        if (send.reg != nullptr || !judged_.insert({send.span.offset, send.command}).second) return;
        if (const auto select = select_command(send.command))
            return judge(send, select->selection.group, select->selection.index);
        const unsigned number = send.command & 0x1FU;
        const auto first = static_cast<unsigned>(Number::use_set_1);
        if (number < first || number > static_cast<unsigned>(Number::use_set_4)) return;
        // Only the groups used in every set: T and Z are often left unchanged.
        for (const Group group : {Group::p, Group::v, Group::a}) judge(send, group, number - first + 1);
    }

    void judge(const Send& send, Group group, unsigned index) {
        const std::uint8_t number = register_of(group, index);
        if (given_.contains(number)) return;
        const std::string name(registers::find(registers::Model::mac140, number)->name);
        const bool is_place = group == Group::p;
        report_.add(
            "W017", send.span,
            is_place ? fmt::format("{} is never given a value: with a {} it is the place 0", name,
                                   drive_.program_name)
                     : fmt::format("{} is never given a value: with a {} selecting it changes nothing", name,
                                   drive_.program_name),
            fmt::format(
                "give it one in VAR_MOTOR; the gateway keeps {} for the drive, and forgets it when it "
                "is switched off",
                name));
    }

    const Plan& plan_;
    const registers::DriveModel& drive_;
    Report& report_;
    std::set<std::uint8_t> given_;
    std::set<std::pair<std::uint32_t, std::uint8_t>> judged_;
};

}  // namespace

void check_drive_registers(const Plan& plan, const registers::DriveModel& drive, Report& report) {
    UnsetRegisters(plan, drive, report).run();
}

}  // namespace nplc::seqc
