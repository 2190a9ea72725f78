#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "compiler/model.h"
#include "registers/mac.h"
#include "seqc/seqc.h"
#include "sequencer/term.h"

/// What can be expressed in the language.
namespace nplc::seqc {

/// Why these bytes cannot be a single symbolic TERM; empty if they can.
std::string_view obstacle(sequencer::TermView term, registers::Model model);

/// The command or register write of a term that has one and no obstacle().
Send send_of(sequencer::TermView term, registers::Model model);

/// A register's value as written in a program, and in a physical unit if it has one. With a SCALE that gives
/// an exact length, positions are written in that unit; with `exact_places` in counts where it is rounded.
struct ValueText {
    std::string text;
    std::string comment;  ///< "1500.1 rpm"; may be empty
};
ValueText value_text(const registers::Register& reg, std::uint32_t bits, const Symbols& symbols,
                     bool exact_places);

}  // namespace nplc::seqc
