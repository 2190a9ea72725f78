#pragma once

#include <cstdint>
#include <optional>

#include "semantics/scope.h"
#include "sequencer/term.h"
#include "syntax/ast.h"

namespace nplc::seqc {

/// The one term that a TERM in symbols is (001 §6.1.5 - §6.1.8); reports what a single term cannot hold.
/// `inside`: the number of the step it stands in, if it stands in one. After an error the bytes mean nothing
/// but their step.
sequencer::TermBytes encode_term(const ast::SymbolicTerm& written, Span span,
                                 std::optional<std::uint8_t> inside, Scope& scope);

}  // namespace nplc::seqc
