#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "registers/mac.h"
#include "seqc/seqc.h"

namespace nplc::seqc {

struct DecompileOptions {
    std::string origin;                     ///< the table's file, for the comment at the head
    std::optional<registers::Model> motor;  ///< nothing: that of `symbols`, else the one that fits
    /// The drive that a gateway translates for, if `motor` is said; else that of `symbols`.
    const registers::DriveModel* drive = nullptr;
    const Symbols* symbols = nullptr;  ///< names to use; those that are no names are made up
};

struct Decompilation {
    std::string text;                  ///< compiling it gives the table's bytes again
    std::string error;                 ///< why there is no text; empty when there is
    std::size_t trailing_bytes = 0;    ///< after the end term, left out
    std::size_t structured_steps = 0;  ///< without any TERM
    std::size_t mixed_steps = 0;       ///< branches and TERMs
    std::size_t term_steps = 0;        ///< TERMs alone
    std::size_t symbolic_terms = 0;
    std::size_t byte_terms = 0;
};

/// A raw table as a program in the terms of people: IF, OUT, ENTRY and ON ERROR where they give the same
/// bytes, single TERMs where they do not, bytes for what has no words. Compiled and compared before it is
/// handed out. Takes terms of 8 bytes up to the first whose STATE is 63.
Decompilation decompile(std::span<const std::uint8_t> table, const DecompileOptions& options);

}  // namespace nplc::seqc
