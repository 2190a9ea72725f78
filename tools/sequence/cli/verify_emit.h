#pragma once

#include <string>
#include <vector>

#include "analysis/property.h"
#include "cli/input.h"

namespace nplc::seqc::cli {

/// `verify --emit`: the question of --assume any in the input language of another checker, to a file or
/// standard output.
int emit_question(const std::string& language, const Input& input,
                  const std::vector<verify::Property>& properties,
                  const std::vector<verify::Assumption>& assumptions, const std::string& output);

}  // namespace nplc::seqc::cli
