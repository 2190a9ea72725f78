#include <fmt/format.h>

#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/session.h"
#include "macreg/assignments.h"
#include "macreg/change.h"
#include "macreg/limits.h"
#include "macreg/values.h"

namespace nplc::macreg::cli {
namespace {

using registers::Model;
using registers::Register;

struct SetArguments {
    std::vector<std::string> words;
    bool force = false;
};

RawValues values_of(const std::vector<Assignment>& all) {
    RawValues values;
    for (const Assignment& one : all) values[one.reg->number] = one.raw;
    return values;
}

void look_for_danger(Session& session, const std::vector<Assignment>& all, bool force,
                     const std::string& limits) {
    std::map<std::string, std::string> dangers;  // what may happen, and by which registers
    for (const Assignment& one : all) {
        const Model model = session.motor().model();
        if (const std::string problem = no_mode(model, *one.reg, one.raw); !problem.empty())
            throw UserError(problem);
        if (one.reg->access == registers::Access::read_only && !force)
            throw UserError(
                fmt::format("{} is read only: the motor overwrites it, or it only tells something; --force "
                            "writes it all the same",
                            one.reg->name));
        if (const std::string what = danger(model, *one.reg, one.raw); !what.empty()) {
            std::string& names = dangers[what];
            names += fmt::format("{}{}", names.empty() ? "" : ", ", one.reg->name);
        }
    }
    if (dangers.empty() && limits.empty()) return;
    std::string text = limits;
    for (const auto& [what, names] : dangers)
        text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", names, what);
    if (!force) throw UserError(text + "; --force if you know that it is right");
    session.ask(text);
}

std::string line_of(const Assignment& one, Model model, const Outcome& outcome) {
    return fmt::format("{} = {} (raw {}; was {})", one.reg->name,
                       long_value_text(*one.reg, model, outcome.after), outcome.after,
                       long_value_text(*one.reg, model, outcome.before));
}

/// Not all of it was written.
[[noreturn]] void broke_off(const std::string& why, int exit_code, const std::vector<Assignment>& all,
                            std::size_t done, bool in_doubt) {
    std::string written;
    Json names = Json::array();
    for (std::size_t i = 0; i < done; ++i) {
        written += fmt::format("{}{}", written.empty() ? "" : ", ", all[i].reg->name);
        names.push_back(all[i].reg->name);
    }
    std::string text = fmt::format("{}; {}", why, done == 0 ? "nothing was written" : "written: " + written);
    if (in_doubt)
        text = fmt::format("{}{}; {} may have been written or not", why,
                           done == 0 ? "" : "; written: " + written, all[done].reg->name);
    throw command_line::Failure(exit_code, text, {{"written", names}, {"of", all.size()}});
}

void set(Session& session, const SetArguments& options) {
    const Model model = session.motor().model();
    auto [all, wrong] = read_assignments(model, options.words);
    if (!wrong.empty()) throw UserError(wrong);
    const RawValues wanted = values_of(all);
    const RawValues limits = read_limits(session.motor(), wanted);
    look_for_danger(session, all, options.force, limits_danger(limits, wanted));
    order_limits(limits, wanted, all);
    std::string text;
    Json done = Json::array();
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Assignment& one = all[i];
        if (!goes_on()) broke_off("interrupted", command_line::kInterrupted, all, i, false);
        const Outcome outcome = [&] {
            try {
                return change(session.motor(), *one.reg, one.raw);
            } catch (const mactalk_client::LineError& error) {
                broke_off(error.what(), command_line::kNoAnswer, all, i, true);
            } catch (const Doubtful& error) {
                broke_off(error.what(), command_line::kNoAnswer, all, i, true);
            }
        }();
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
    const auto options = std::make_shared<SetArguments>();
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
