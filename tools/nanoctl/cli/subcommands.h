#pragma once

#include "cli/session.h"

/// Each adds its subcommands; their work ends in common.exit_code.
namespace nplc::nanoctl::cli {

void add_transfers(CLI::App& app, Common& common);  ///< upload, verify, download
void add_controls(CLI::App& app, Common& common);   ///< run, stop, safe, hold, activate, reset
void add_stepping(CLI::App& app, Common& common);   ///< step, scan
void add_status(CLI::App& app, Common& common);     ///< status, watch
void add_break(CLI::App& app, Common& common);
void add_force(CLI::App& app, Common& common);
void add_log(CLI::App& app, Common& common);
void add_settings(CLI::App& app, Common& common);

}  // namespace nplc::nanoctl::cli
