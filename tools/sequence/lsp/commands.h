#pragma once

#include <string>

#include "lsp/verifier.h"
#include "lsp/workspace.h"

/// Results of workspace/executeCommand.
namespace nplc::seqc::lsp {

/// {"dot": Graphviz text, "svg": the drawing, "steps": {"name": line}}; throws ResponseError for a program
/// with errors.
Json dot_of(Workspace& workspace, const Document& document);

/// Steps, inputs, outputs and registers with their numbers and lines, for live views.
Json description_of(Workspace& workspace, const Document& document);

/// {"states", "complete", "results": [{"name", "code", "message", "level"}]}
Json results_of(const VerifyOutcome& outcome);

/// {"name", "scenario"} of a broken property, the first without a name; throws ResponseError if there is
/// none.
Json counterexample_of(const VerifyOutcome& outcome, const std::string& name);

}  // namespace nplc::seqc::lsp
