#pragma once

#include "arguments/arguments.h"

/// Each adds one subcommand, whose callback does the work and sets the exit code.
namespace nplc::seqc::cli {

void add_build(arguments::App& app, int& exit_code);
void add_check(arguments::App& app, int& exit_code);
void add_dap(arguments::App& app, int& exit_code);
void add_decompile(arguments::App& app, int& exit_code);
void add_diff(arguments::App& app, int& exit_code);
void add_disasm(arguments::App& app, int& exit_code);
void add_explain(arguments::App& app, int& exit_code);
void add_fmt(arguments::App& app, int& exit_code);
void add_graph(arguments::App& app, int& exit_code);
void add_lsp(arguments::App& app, int& exit_code);
void add_report(arguments::App& app, int& exit_code);
void add_verify(arguments::App& app, int& exit_code);

/// All that this program has.
void add_subcommands(arguments::App& app, int& exit_code);

}  // namespace nplc::seqc::cli
