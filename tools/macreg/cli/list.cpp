#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/session.h"
#include "macreg/mactalk_names.h"
#include "macreg/values.h"

namespace nplc::macreg::cli {
namespace {

using registers::Access;
using registers::Model;
using registers::Register;

struct ListArguments {
    std::string pattern;
    bool dangerous = false;
    bool writable = false;
};

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

bool is_wanted(const Register& reg, Model model, const ListArguments& options) {
    if (options.dangerous && !reg.dangerous) return false;
    if (options.writable && reg.access == Access::read_only) return false;
    const std::string all =
        fmt::format("{} {} {}", reg.name, registers::details_of(model, reg.number)->title, mactalk_name(reg));
    return lower(all).find(lower(options.pattern)) != std::string::npos;
}

Json document_of(const Register& reg, Model model) {
    const registers::Details& details = *registers::details_of(model, reg.number);
    Json fields = Json::array();
    for (const registers::Field& field : registers::fields_of(model, reg.number)) {
        Json values = Json::object();
        for (const auto& value : field.values) values[std::string(value.name)] = value.value;
        fields.push_back(
            {{"name", field.name}, {"bit", field.first}, {"width", field.width}, {"values", values}});
    }
    return {{"number", reg.number},
            {"name", reg.name},
            {"title", details.title},
            {"mactalk", mactalk_name(reg)},
            {"format", registers::name_of(reg.format)},
            {"min", reg.min},
            {"max", reg.max},
            {"range", range_text(reg, model)},
            {"access", registers::name_of(reg.access)},
            {"dangerous", reg.dangerous},
            {"section", reg.section},
            {"note", details.note},
            {"fields", fields}};
}

std::string line_of(const Register& reg, Model model) {
    const char* access = reg.access == Access::read_only ? "r " : "rw";
    return fmt::format("{:>3}  {:<14} {} {} {:<9} {}\n", reg.number, reg.name, access,
                       reg.dangerous ? "!" : " ", registers::name_of(reg.format),
                       registers::details_of(model, reg.number)->title);
}

/// All of one register, if only one is asked for.
std::string whole(const Register& reg, Model model) {
    const registers::Details& details = *registers::details_of(model, reg.number);
    std::string text = fmt::format("{} {}: {}\n  {}, {}{}, {}\n", reg.number, reg.name, details.title,
                                   registers::name_of(reg.format), registers::name_of(reg.access),
                                   reg.dangerous ? ", dangerous" : "", reg.section);
    text += fmt::format("  range {}\n", range_text(reg, model));
    if (const auto name = mactalk_name(reg); !name.empty())
        text += fmt::format("  in the program MacTalk: {}\n", name);
    if (!details.note.empty()) text += fmt::format("  note: {}\n", details.note);
    for (const registers::Field& field : registers::fields_of(model, reg.number)) {
        text += fmt::format("  bit {:>2} {:<13} {}\n", field.first, field.name, field.meaning);
        for (const auto& value : field.values)
            text += fmt::format("      {:>5} {:<13} {}\n", value.value, value.name, value.meaning);
    }
    return text;
}

Model model_for_list(const Common& common) {
    if (const auto model = model_option(common)) return *model;
    if (common.port.empty()) return Model::mac140;
    return Session(common).motor().model();
}

void list(Common& common, const ListArguments& options) {
    const Model model = model_for_list(common);
    std::vector<const Register*> wanted;
    for (const Register& reg : registers::map_of(model)) {
        if (is_wanted(reg, model, options)) wanted.push_back(&reg);
    }
    if (const NamedRegister exact = find_register(model, options.pattern); exact.reg != nullptr)
        wanted = {exact.reg};
    if (wanted.empty())
        throw UserError(
            fmt::format("no register has '{}' in its name, its title or what MacTalk calls it; `macreg list` "
                        "shows them all",
                        options.pattern));
    std::string text = wanted.size() == 1 ? whole(*wanted[0], model) : "";
    Json documents = Json::array();
    for (const Register* reg : wanted) {
        if (wanted.size() > 1) text += line_of(*reg, model);
        documents.push_back(document_of(*reg, model));
    }
    text.pop_back();
    command_line::tell(common, text, {{"model", registers::name_of(model)}, {"registers", documents}});
}

}  // namespace

void add_list(arguments::App& app, Common& common) {
    const auto options = std::make_shared<ListArguments>();
    arguments::App& command = add_command(
        app, "list",
        "The registers of a model; r: read only, !: dangerous. Of one register all there is to know. "
        "Needs no motor: without --port and --model it shows MAC50 to MAC141");
    command.add_option("pattern", options->pattern,
                       "A register, or a part of names, titles and MacTalk's names (Max velocity)");
    command.add_flag("--dangerous", options->dangerous, "Only those that `set` changes with --force only");
    command.add_flag("--writable", options->writable, "Only those that are not read only");
    command.callback([options, &common] { guard(common, [&] { list(common, *options); }); });
}

}  // namespace nplc::macreg::cli
