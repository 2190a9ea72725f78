#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "cli/session.h"
#include "host/terminal.h"
#include "macreg/change.h"
#include "macreg/values.h"
#include "macreg/why.h"
#include "text/text.h"

namespace nplc::macreg::cli {

using registers::Access;
using registers::Model;
using registers::Register;

namespace {

struct ListArguments {
    std::string pattern;
    bool dangerous = false;
    bool writable = false;
};

bool is_wanted(const Register& reg, Model model, const ListArguments& options) {
    if (options.dangerous && !reg.dangerous) return false;
    if (options.writable && reg.access == Access::read_only) return false;
    const std::string all =
        fmt::format("{} {} {}", reg.name, registers::details_of(model, reg.number)->title, mactalk_name(reg));
    return spelling::lower(all).find(spelling::lower(options.pattern)) != std::string::npos;
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

/// All details of the register, if only one is asked for.
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
    std::map<std::string, std::string> dangers;  // the warnings, and the registers that cause them
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

std::string line_of(const Assignment& one, Model model, const ChangeResult& outcome) {
    const std::string before =
        outcome.before ? "; was " + long_value_text(*one.reg, model, *outcome.before) : "";
    return fmt::format("{} = {} (raw {}{})", one.reg->name, long_value_text(*one.reg, model, outcome.after),
                       outcome.after, before);
}

/// Only part of it was written.
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

void set_in(Session& session, const SetArguments& options) {
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
        const ChangeResult outcome = [&] {
            try {
                return change(session.motor(), *one.reg, one.raw);
            } catch (const mactalk_client::Ended& error) {
                const bool is_unstopped =
                    is_stop(model, *one.reg, one.raw) && error.exit_code() == command_line::kNoAnswer;
                broke_off(error.what(), is_unstopped ? command_line::kNotConfirmed : error.exit_code(), all,
                          i, true);
            }
        }();
        Json document = value_document(*one.reg, model, outcome.after);
        if (outcome.before) document["before"] = *outcome.before;
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

/// The stop among the values, if they are right for one of the models that the motor may be.
std::optional<std::int64_t> stop_in(const Common& common, const SetArguments& options) {
    const auto named = model_option(common);
    for (const Model model : {named.value_or(Model::mac140), named.value_or(Model::mac800)}) {
        const auto [all, wrong] = read_assignments(model, options.words);
        if (!wrong.empty()) continue;
        for (const Assignment& one : all) {
            if (is_stop(model, *one.reg, one.raw)) return one.raw;
        }
    }
    return std::nullopt;
}

void set(Common& common, const SetArguments& options) {
    if (const auto stop = stop_in(common, options)) {
        Session session(common, *stop);
        return set_in(session, options);
    }
    Session session(common);
    set_in(session, options);
}

struct WatchArguments {
    std::vector<std::string> names;
    unsigned interval_ms = 200;
    double seconds = 0;
    bool all = false;
};

/// The registers of general interest on any motor.
const std::vector<std::string> kUsual{"MODE_REG", "P_SOLL", "P_IST",  "V_SOLL",
                                      "V_IST",    "VF_OUT", "FLWERR", "ERR_STAT"};

std::string seconds_text(base::Microseconds time) {
    return fmt::format("{:.3f}", static_cast<double>(time.count()) / 1e6);
}

/// A table that is redrawn, or a line or document at every change.
class Table {
  public:
    Table(Session& session, const WatchArguments& options, std::vector<const Register*> registers)
        : session_(session),
          options_(options),
          registers_(std::move(registers)),
          model_(session.motor().model()),
          drawn_over_(host::is_terminal(stdout) && !session.json()),
          begun_(session.now()) {}

    void show(const Snapshot& snapshot) {
        if (drawn_over_) return draw(snapshot);
        if (!options_.all && last_ && last_->values() == snapshot.values()) return;
        session_.json() ? document(snapshot) : line(snapshot);
        last_ = snapshot;
    }

  private:
    void draw(const Snapshot& snapshot) {
        std::string text = last_ ? fmt::format("\033[{}A", registers_.size() + 1) : "";
        text += fmt::format("\033[K{} s, Ctrl-C ends\n", seconds_text(snapshot.time() - begun_));
        for (const Register* reg : registers_) {
            const std::int64_t raw = snapshot.at(reg->number);
            const bool changed = last_ && last_->at(reg->number) != raw;
            text += fmt::format("\033[K{}{:<14} {:<28} {:>12}\033[0m\n", changed ? "\033[1m" : "", reg->name,
                                value_text(*reg, model_, raw), raw);
        }
        fmt::print("{}", text);
        std::fflush(stdout);
        last_ = snapshot;
    }

    void line(const Snapshot& snapshot) {
        std::string text = fmt::format("{:>9}", seconds_text(snapshot.time() - begun_));
        for (const Register* reg : registers_)
            text += fmt::format("  {} {}", reg->name, value_text(*reg, model_, snapshot.at(reg->number)));
        session_.tell(text, {});
    }

    void document(const Snapshot& snapshot) {
        Json values = Json::object();
        for (const Register* reg : registers_) values[std::string(reg->name)] = snapshot.at(reg->number);
        session_.tell("", {{"seconds", static_cast<double>((snapshot.time() - begun_).count()) / 1e6},
                           {"raw", values}});
    }

    Session& session_;
    const WatchArguments& options_;
    std::vector<const Register*> registers_;
    Model model_;
    bool drawn_over_;
    base::Instant begun_;
    std::optional<Snapshot> last_;
};

void watch(Session& session, const WatchArguments& options) {
    const auto registers =
        find_registers(session.motor().model(), options.names.empty() ? kUsual : options.names);
    Table table(session, options, registers);
    command_line::watch(session, base::Milliseconds{options.interval_ms}, options.seconds,
                        [&] { table.show(session.motor().read_block(registers)); });
}

void why(Session& session) {
    const Condition condition = read_condition(session.motor());
    tell_findings(session.common(), macreg::why(condition), "registers", [&](std::string_view name) {
        const Register& reg = *registers::find(condition.model, name);
        const std::int64_t raw = condition.now.at(reg.number);
        return ShownValue{long_value_text(reg, condition.model, raw),
                          value_document(reg, condition.model, raw)};
    });
}

}  // namespace

void add_list(arguments::App& app, Common& common) {
    auto [command, options] =
        add_command(app, common, "list",
                    "The registers of a model; r: read only, !: dangerous. Of one register all there is to "
                    "know. Needs no motor: without --port and --model it shows MAC50 to MAC141",
                    list);
    command.add_option("pattern", options.pattern,
                       "A register, or a part of names, titles and MacTalk's names (Max velocity)");
    command.add_flag("--dangerous", options.dangerous, "Only those that `set` changes with --force only");
    command.add_flag("--writable", options.writable, "Only those that are not read only");
}

void add_get(arguments::App& app, Common& common) {
    auto [command, names] =
        add_command(app, common, "get", "Read registers and show them in their units", get);
    command.add_option("registers", names, "Names or numbers")->required();
}

void add_set(arguments::App& app, Common& common) {
    auto [command, options] = add_command(
        app, common, "set",
        "Change registers and read them back. A value may have a unit (1500rpm), be raw steps (1600, "
        "raw:1600, 0x640), or names (P_MODE, HICLK+INPSIGN). All are checked before the first is written",
        set);
    command.add_option("values", options.words, "NAME VALUE, or NAME=VALUE; several at once")->required();
    command.add_flag("--force", options.force,
                     "Write dangerous and read-only registers too; the former are asked for");
}

void add_watch(arguments::App& app, Common& common) {
    auto [command, options] = add_command(app, common, "watch",
                                          "Registers as they change: a table on a terminal, else a line (or "
                                          "with --json a document) at every change. Ctrl-C ends it",
                                          watch);
    command.add_option("registers", options.names,
                       "Names or numbers; else mode, positions, velocities, torque, errors");
    command.add_option("--interval", options.interval_ms, "Milliseconds between two looks")
        ->capture_default_str()
        ->in_range(0, 60'000);
    command.add_option("--for", options.seconds, "End after so many seconds; 0: at Ctrl-C")->non_negative();
    command.add_flag("--all", options.all, "A line at every look, changed or not");
}

void add_why(arguments::App& app, Common& common) {
    add_command(app, common, "why",
                "Why does it not move? Sentences with the registers that make it so and what mends it, the "
                "first thing to mend in front",
                why);
}

}  // namespace nplc::macreg::cli
