#pragma once

#include "cli/session.h"

/// Each adds its subcommands from a file of its own; their work ends in common.exit_code.
namespace nplc::macreg::cli {

void add_list(CLI::App& app, Common& common);
void add_get(CLI::App& app, Common& common);
void add_monitor(CLI::App& app, Common& common);
void add_plot(CLI::App& app, Common& common);
void add_record(CLI::App& app, Common& common);
void add_ui(CLI::App& app, Common& common);

}  // namespace nplc::macreg::cli
