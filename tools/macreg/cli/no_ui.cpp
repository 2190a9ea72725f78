#include "cli/session.h"

namespace nplc::macreg::cli {

namespace {

void ui(Common&) {
    throw UserError("this macreg was built without the full screen, which needs ncurses; use watch");
}

}  // namespace

void add_ui(arguments::App& app, Common& common) {
    add_command(app, common, "ui",
                "The full screen; not in this program, which was built without ncurses: see watch", ui);
}

}  // namespace nplc::macreg::cli
