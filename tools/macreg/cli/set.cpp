#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "cli/subcommands.h"
#include "macreg/change.h"
#include "macreg/values.h"
#include "registers/scale.h"

namespace nplc::macreg::cli {
namespace {

using registers::Model;
using registers::Register;

struct Options {
    std::vector<std::string> words;
    bool force = false;
};

struct Assignment {
    const Register* reg;
    std::string text;
    std::int64_t raw = 0;
    std::string rounding{};
};

/// A unit that stands apart, or one more bit's name.
bool belongs_to_value(const Register& reg, Model model, const std::string& word) {
    if (registers::find(model, std::string_view(word)) != nullptr) return false;
    if (reg.unit == registers::Unit::bits)
        return typed_value(reg, model, word).error.empty() && word.find_first_of("0123456789") != 0;
    return registers::raw_per_unit(reg, model, word).has_value();
}

/// NAME VALUE or NAME=VALUE, also several; a unit may stand apart: `V_SOLL 1500 rpm`.
std::vector<Assignment> taken_apart(Model model, const std::vector<std::string>& words) {
    std::vector<Assignment> all;
    for (std::size_t i = 0; i < words.size();) {
        const auto equals = words[i].find('=');
        const std::string name = words[i].substr(0, equals);
        const NamedRegister named = find_register(model, name);
        if (named.reg == nullptr) throw UserError(named.error);
        Assignment one{.reg = named.reg,
                       .text = equals == std::string::npos ? "" : words[i].substr(equals + 1)};
        ++i;
        if (one.text.empty() && i < words.size()) one.text = words[i++];
        while (i < words.size() && belongs_to_value(*named.reg, model, words[i]))
            one.text += " " + words[i++];
        if (one.text.empty())
            throw UserError(fmt::format("'{}': write {} VALUE or {}=VALUE", name, name, name));
        all.push_back(one);
    }
    return all;
}

std::vector<Assignment> assignments(Model model, const std::vector<std::string>& words) {
    std::vector<Assignment> all = taken_apart(model, words);
    for (std::size_t i = 0; i < all.size(); ++i) {
        Assignment& one = all[i];
        TypedValue typed = typed_value(*one.reg, model, one.text);
        if (!typed.error.empty()) throw UserError(typed.error);
        for (std::size_t k = 0; k < i; ++k) {
            if (all[k].reg == one.reg)
                throw UserError(fmt::format("{} is named twice; name it once", one.reg->name));
        }
        one.raw = typed.raw;
        one.rounding = std::move(typed.rounding);
    }
    return all;
}

void look_for_danger(Session& session, const std::vector<Assignment>& all, bool force) {
    std::string dangerous;
    for (const Assignment& one : all) {
        if (const std::string problem = no_mode(session.motor().model(), *one.reg, one.raw); !problem.empty())
            throw UserError(problem);
        if (one.reg->access == registers::Access::read_only && !force)
            throw UserError(
                fmt::format("{} is read only: the motor overwrites it, or it only tells something; --force "
                            "writes it all the same",
                            one.reg->name));
        if (one.reg->dangerous) dangerous += (dangerous.empty() ? "" : ", ") + std::string(one.reg->name);
    }
    if (dangerous.empty()) return;
    if (!force)
        throw UserError(
            fmt::format("{}: a wrong value may damage the motor or upset its control; --force if you "
                        "know that it is right",
                        dangerous));
    session.ask(fmt::format("{}: a wrong value may damage the motor or upset its control", dangerous));
}

std::string line_of(const Assignment& one, Model model, const Outcome& outcome) {
    return fmt::format("{} = {} (raw {}; was {})", one.reg->name, value_text(*one.reg, model, outcome.after),
                       outcome.after, value_text(*one.reg, model, outcome.before));
}

void set(Session& session, const Options& options) {
    const Model model = session.motor().model();
    const auto all = assignments(model, options.words);
    look_for_danger(session, all, options.force);
    std::string text;
    Json done = Json::array();
    for (const Assignment& one : all) {
        look_for_interruption();
        const Outcome outcome = change(session.motor(), *one.reg, one.raw);
        Json document = value_document(*one.reg, model, outcome.after);
        document["before"] = outcome.before;
        if (!one.rounding.empty()) document["rounding"] = one.rounding;
        if (!outcome.remark.empty()) document["remark"] = outcome.remark;
        if (!outcome.taken) {
            if (!text.empty() && !session.json()) fmt::print("{}\n", text);
            refuse(fmt::format("{}: {} was not taken, it is {} (raw {}): {}", one.reg->name, one.text,
                               value_text(*one.reg, model, outcome.after), outcome.after, outcome.why),
                   {{"register", document}, {"reason", outcome.why}, {"written", done}});
        }
        if (!one.rounding.empty()) session.remark(one.rounding);
        if (!outcome.remark.empty()) session.remark(fmt::format("{}: {}", one.reg->name, outcome.remark));
        text += (text.empty() ? "" : "\n") + line_of(one, model, outcome);
        done.push_back(document);
    }
    session.tell(text, {{"registers", done}});
}

}  // namespace

void add_set(arguments::App& app, Common& common) {
    const auto options = std::make_shared<Options>();
    arguments::App& command =
        add_command(app, "set",
                    "Change registers and read them back. A value may have a unit (1500rpm), be raw steps "
                    "(1600, raw:1600, 0x640), "
                    "or names (P_MODE, HICLK+INPSIGN). All are checked before the first is written");
    command.add_option("values", options->words, "NAME VALUE, or NAME=VALUE; several at once")->required();
    command.add_flag("--force", options->force,
                     "Write dangerous and read-only registers too; the former are asked for");
    command.callback([options, &common] { work(common, [&](Session& s) { set(s, *options); }); });
}

}  // namespace nplc::macreg::cli
