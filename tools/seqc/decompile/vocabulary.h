#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "registers/mac.h"
#include "semantics/model.h"
#include "seqc/seqc.h"
#include "sequencer/term.h"

/// What the language has words for.
namespace nplc::seqc {

/// Why a single TERM in symbols cannot be these bytes; empty if it can.
std::string_view obstacle(sequencer::TermView bytes, registers::Model model);

/// The command or register write of a term that has one and no obstacle.
Send send_of(const sequencer::Term& term, registers::Model model);

/// A register's value as it is written in a program, and in a physical unit if it has one. With a scale whose
/// length is exact, positions are written in it.
struct ValueText {
    std::string text;
    std::string comment;  ///< "1500.1 rpm"; may be empty
};
ValueText value_text(const registers::Register& reg, std::uint32_t bits, const Symbols& symbols);

}  // namespace nplc::seqc
