#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "seqc/seqc.h"

namespace nplc::seqc::cli {

/// One JSON document on standard output; what is no UTF-8 is replaced. Answers `exit_code`, or another one
/// if it cannot be written.
int print_json(const nlohmann::ordered_json& document, int exit_code);

/// {"file", "ok", "errors", "warnings", "more", "diagnostics": [...]}; lines and columns count from 1,
/// columns in characters, the end is behind the last character.
nlohmann::ordered_json diagnostics_document(const Compilation& compilation, const Sources& sources);

/// The same for a file that cannot be read or written: no diagnostics, and "error" says why.
nlohmann::ordered_json problem_document(const std::string& file_name, const std::string& problem);

}  // namespace nplc::seqc::cli
