// Checks a program for a drive without registers: registers that are selected but never written.
#include <fmt/format.h>

#include <set>
#include <string>

#include "compiler/checker.h"
#include "sequencer/state.h"
#include "symbols/commands.h"
#include "symbols/motors.h"

namespace nplc::seqc {
namespace {

using table::Group;

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
        if (!sequencer::is_flex(term.bytes)) return;
        const sequencer::MotorOrder write = sequencer::order_of(term.bytes);
        given_.insert(write.reg);
        if (write.longword) given_.insert(static_cast<std::uint8_t>(write.reg + 1));
    }

    void judge(const Send& send) {
        if (send.reg != nullptr || !judged_.insert({send.span.offset, send.command}).second) return;
        if (const auto select = select_command(send.command)) return judge(send, select->selection);
        const auto set = table::set_used(send.command);
        if (!set) return;
        // Only the groups used in every set: T and Z are often left unchanged.
        for (const Group group : {Group::p, Group::v, Group::a}) judge(send, {group, *set});
    }

    void judge(const Send& send, Selection selection) {
        const std::uint8_t number = table::register_of(selection);
        if (given_.contains(number)) return;
        const std::string name(registers::find(registers::Model::mac140, number)->name);
        const bool is_place = selection.group == Group::p;
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
