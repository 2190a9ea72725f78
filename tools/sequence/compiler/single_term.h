#pragma once

#include <cstdint>
#include <optional>

#include "compiler/scope.h"
#include "language/ast.h"
#include "sequencer/term.h"

namespace nplc::seqc {

/// Encodes a symbolic TERM as its single term (001 §6.1.5 - §6.1.8); reports parts that do not fit into a
/// single term. `inside`: the number of the enclosing step, if any. After an error only the step in the bytes
/// is valid.
sequencer::TermBytes encode_term(const ast::SymbolicTerm& written, Span span,
                                 std::optional<std::uint8_t> inside, Scope& scope);

}  // namespace nplc::seqc
