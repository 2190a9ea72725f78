#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "seqc/seqc.h"

namespace nplc::seqc::cli {

/// Prints one JSON document on standard output; invalid UTF-8 is replaced. Returns `exit_code`, or another
/// one on a write error.
int print_json(const nlohmann::ordered_json& document, int exit_code);

/// {"file", "ok", "errors", "warnings", "more", "diagnostics": [...]}; lines and columns count from 1,
/// columns in characters, the end is behind the last character.
nlohmann::ordered_json diagnostics_document(const Compilation& compilation, const Sources& sources);

/// The same for a file that cannot be read or written: no diagnostics, the reason in "error".
nlohmann::ordered_json problem_document(const std::string& file_name, const std::string& problem);

}  // namespace nplc::seqc::cli
