#pragma once

#include <CLI/CLI.hpp>

/// Each adds one subcommand, whose callback does its work and leaves the exit code.
namespace nplc::seqc::cli {

void add_build(CLI::App& app, int& exit_code);
void add_check(CLI::App& app, int& exit_code);
void add_decompile(CLI::App& app, int& exit_code);
void add_diff(CLI::App& app, int& exit_code);
void add_disasm(CLI::App& app, int& exit_code);
void add_explain(CLI::App& app, int& exit_code);
void add_fmt(CLI::App& app, int& exit_code);
void add_graph(CLI::App& app, int& exit_code);
void add_report(CLI::App& app, int& exit_code);

}  // namespace nplc::seqc::cli
