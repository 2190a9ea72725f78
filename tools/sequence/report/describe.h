#pragma once

#include <string>

#include "seqc/seqc.h"
#include "sequencer/term.h"

namespace nplc::seqc {

/// A term in words of the language: "Idle: IF Start AND NOT ERROR THEN POSITION(P2); OUT Grip; NEXT :=
/// Travel". Without symbols steps and signals are numbers.
std::string describe(sequencer::TermView term, const Symbols* symbols);

/// "TERM 16#C0, 16#01, ...;"
std::string byte_line(sequencer::TermView term);

}  // namespace nplc::seqc
