#pragma once

#include "compiler/model.h"
#include "compiler/sequence_calls.h"
#include "diagnostics/report.h"
#include "seqc/seqc.h"

namespace nplc::seqc {

/// A step's memory besides its number (outputs that are set, armed edges, a running time, a blinking lamp
/// that is off) is represented by steps of the table: one copy of the step for each reachable combination.
/// The first one reached keeps the step's number. No effect on a program without SET, R_TRIG, FOR and
/// BLINKING. Names are added to the symbols of `result`; reports lack of space, with what takes it, or a
/// conflict with NO_HELPER.
void make_copies(Plan& plan, const SequenceCalls& calls, Compilation& result, Report& report);

/// Reports a timer that a program presets and tests, with a WITHIN, FOR or BLINKING of a step in between;
/// for a step of a SEQUENCE once, with the calls in which it is so.
void check_shared_timer(const Plan& plan, const SequenceCalls& calls, Report& report);

}  // namespace nplc::seqc
