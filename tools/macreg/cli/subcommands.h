#pragma once

#include "cli/session.h"

/// Each adds its subcommands from a file of its own; their work ends in common.exit_code.
namespace nplc::macreg::cli {

void add_list(CLI::App& app, Common& common);
void add_get(CLI::App& app, Common& common);
void add_set(CLI::App& app, Common& common);
void add_watch(CLI::App& app, Common& common);
void add_why(CLI::App& app, Common& common);
void add_dump(CLI::App& app, Common& common);
void add_load(CLI::App& app, Common& common);
void add_diff(CLI::App& app, Common& common);
void add_service(CLI::App& app, Common& common);  ///< flash, safe, reset, prepare
void add_find(CLI::App& app, Common& common);
void add_monitor(CLI::App& app, Common& common);
void add_plot(CLI::App& app, Common& common);
void add_record(CLI::App& app, Common& common);
void add_ui(CLI::App& app, Common& common);

}  // namespace nplc::macreg::cli
