#include "command_line/generated.h"

#include <fmt/format.h>

namespace nplc::command_line {

void add_generated(arguments::App& app, Common& common, About about) {
    about.file_options.insert("--port");
    about.option_words["--baud"] = {"9600", "19200", "38400", "57600", "115200", "230400"};
    arguments::add_pages(app, std::move(about), [&common](const std::string& text) {
        guard(common, [&] { fmt::print("{}", text); });
    });
}

}  // namespace nplc::command_line
