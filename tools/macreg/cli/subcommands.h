#pragma once

#include "cli/session.h"

/// Each adds its subcommands from a file of its own; their work ends in common.exit_code.
namespace nplc::macreg::cli {

void add_list(arguments::App& app, Common& common);
void add_get(arguments::App& app, Common& common);
void add_set(arguments::App& app, Common& common);
void add_watch(arguments::App& app, Common& common);
void add_why(arguments::App& app, Common& common);
void add_dump(arguments::App& app, Common& common);
void add_load(arguments::App& app, Common& common);
void add_diff(arguments::App& app, Common& common);
void add_service(arguments::App& app, Common& common);  ///< flash, safe, reset, prepare
void add_find(arguments::App& app, Common& common);
void add_monitor(arguments::App& app, Common& common);
void add_plot(arguments::App& app, Common& common);
void add_record(arguments::App& app, Common& common);
void add_ui(arguments::App& app, Common& common);

}  // namespace nplc::macreg::cli
