#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "registers/mac.h"
#include "seqc/seqc.h"

namespace nplc::seqc {

struct DecompileOptions {
    std::string origin;                     ///< the table's file, for the comment in the header
    std::optional<registers::Model> motor;  ///< empty: that of `symbols`, else the best fitting one
    /// The drive that a gateway translates for, if `motor` is given; else that of `symbols`.
    const registers::DriveModel* drive = nullptr;
    const Symbols* symbols = nullptr;  ///< names to use; invalid ones are replaced by generated names
};

struct Decompilation {
    std::string text;                  ///< compiling it reproduces the table's bytes
    std::string error;                 ///< why there is no text; empty on success
    std::size_t trailing_bytes = 0;    ///< after the end term, ignored
    std::size_t structured_steps = 0;  ///< without any TERM
    std::size_t mixed_steps = 0;       ///< branches and TERMs
    std::size_t term_steps = 0;        ///< TERMs alone
    std::size_t symbolic_terms = 0;
    std::size_t byte_terms = 0;
    std::vector<std::string> lost_set_points;  ///< of `symbols`, whose defaults are constants in the text
};

/// Converts a raw table to a readable program: IF, OUT, ENTRY and ON ERROR where they reproduce the bytes,
/// single TERMs where they do not, bytes where there is no symbolic form. The result is compiled and compared
/// before it is returned. Reads terms of 8 bytes up to the first whose STATE is 63.
Decompilation decompile(std::span<const std::uint8_t> table, const DecompileOptions& options);

}  // namespace nplc::seqc
