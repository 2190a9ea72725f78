#pragma once

#include "arguments/pages.h"
#include "command_line/program.h"

namespace nplc::command_line {

using arguments::About;

/// Adds `help`, `completion` and `man`.
void add_generated(arguments::App& app, Common& common, About about);

}  // namespace nplc::command_line
