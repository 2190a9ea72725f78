#include "cli/session.h"

namespace nplc::macreg::cli {

void add_ui(arguments::App& app, Common& common) {
    arguments::App& command = add_command(
        app, "ui", "The full screen; not in this program, which was built without ncurses: see watch");
    command.callback([&common] {
        guard(common, [] {
            throw UserError("this macreg was built without the full screen, which needs ncurses; use watch");
        });
    });
}

}  // namespace nplc::macreg::cli
