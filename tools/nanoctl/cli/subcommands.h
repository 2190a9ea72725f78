#pragma once

#include "cli/session.h"

/// Each adds its subcommands; their work ends in common.exit_code.
namespace nplc::nanoctl::cli {

void add_transfers(arguments::App& app, Common& common);  ///< upload, verify, download
void add_controls(arguments::App& app, Common& common);   ///< run, stop, safe, hold, activate, reset
void add_stepping(arguments::App& app, Common& common);   ///< step, scan
void add_status(arguments::App& app, Common& common);     ///< status, watch
void add_break(arguments::App& app, Common& common);
void add_force(arguments::App& app, Common& common);
void add_log(arguments::App& app, Common& common);
void add_settings(arguments::App& app, Common& common);

}  // namespace nplc::nanoctl::cli
