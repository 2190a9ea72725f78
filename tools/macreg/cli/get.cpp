#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "cli/session.h"
#include "macreg/values.h"

namespace nplc::macreg::cli {
namespace {

using registers::Register;

std::string line_of(const Register& reg, registers::Model model, std::int64_t raw, std::size_t width) {
    const std::string value = long_value_text(reg, model, raw);
    const std::string plain = fmt::format("{}", raw);
    const std::string behind = value == plain ? "" : fmt::format("   (raw {})", raw);
    return fmt::format("{:<{}} = {}{}", reg.name, width, value, behind);
}

void get(Session& session, const std::vector<std::string>& names) {
    const registers::Model model = session.motor().model();
    const auto wanted = find_registers(model, names);
    const Snapshot snapshot = session.motor().read_block(wanted);
    std::size_t width = 0;
    for (const Register* reg : wanted) width = std::max(width, reg->name.size());
    std::string text;
    Json list = Json::array();
    for (const Register* reg : wanted) {
        const std::int64_t raw = snapshot.at(reg->number);
        text += (text.empty() ? "" : "\n") + line_of(*reg, model, raw, width);
        list.push_back(value_document(*reg, model, raw));
    }
    session.tell(text, {{"registers", list}});
}

}  // namespace

void add_get(arguments::App& app, Common& common) {
    const auto names = std::make_shared<std::vector<std::string>>();
    arguments::App& command = add_command(app, "get", "Read registers and show them in their units");
    command.add_option("registers", *names, "Names or numbers")->required();
    command.callback([names, &common] { work(common, [&](Session& s) { get(s, *names); }); });
}

}  // namespace nplc::macreg::cli
