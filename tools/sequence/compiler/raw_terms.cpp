#include "compiler/raw_terms.h"

#include <fmt/format.h>

#include <string>

#include "compiler/drive.h"
#include "sequencer/term.h"
#include "table/terms.h"

namespace nplc::seqc {
namespace {

void warn_if_not_for_drive(Span span, const sequencer::Term& term, const registers::DriveModel& drive,
                           Report& report) {
    const registers::Refusal why = refusal_of(drive, term);
    if (why.empty()) return;
    report.add("W009", span,
               fmt::format("a gateway with a {} refuses a table with this term", drive.program_name),
               std::string(why));
}

void check_raw_term(const RawTerm& raw, const registers::DriveModel* drive, Report& report) {
    const table::TermFault fault = table::fault_of(raw.bytes);
    if (fault == table::TermFault::next_is_63) {
        report.add("W009", raw.span, "NEXT_STATE is 63: a gateway refuses a table with this term",
                   "write 16#3E as the fourth byte if the step is to stay");
    } else if (fault == table::TermFault::register_0) {
        report.add("W009", raw.span, "register 0: a gateway refuses a table with this term",
                   "bits 6..0 of the fourth byte name the register, 1..127");
    } else if (drive != nullptr) {
        warn_if_not_for_drive(raw.span, sequencer::decode(raw.bytes), *drive, report);
    }
}

}  // namespace

void check_raw_terms(const Plan& plan, const registers::DriveModel* drive, Report& report) {
    for (const StepPlan& step : plan.steps) {
        for (const RawTerm& raw : step.terms) check_raw_term(raw, drive, report);
    }
    for (std::size_t i = 0; i < plan.terms.size(); ++i) {
        const RawTerm& raw = plan.terms[i];
        if (!sequencer::is_end(raw.bytes)) {
            check_raw_term(raw, drive, report);
            continue;
        }
        if (i + 1 == plan.terms.size()) continue;
        report
            .add("E091", plan.terms[i + 1].span, "no term may follow the one that ends the table",
                 "let the TERM with STATE 63 be the last, or delete it: the compiler ends the table")
            .notes.push_back({raw.span, "the table ends here"});
        return;
    }
}

}  // namespace nplc::seqc
