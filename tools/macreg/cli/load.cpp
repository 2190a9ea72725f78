#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "cli/files.h"
#include "cli/subcommands.h"
#include "macreg/change.h"
#include "macreg/parameters.h"
#include "macreg/service.h"
#include "macreg/values.h"

namespace nplc::macreg::cli {
namespace {

using mactalk_client::Interrupted;
using mactalk_client::LineError;
using registers::Model;
using registers::Register;

struct Options {
    std::string file;
    bool stop = false;
    bool force = false;
    bool skip_dangerous = false;
    bool partial = false;
    bool another = false;
};

bool is_address(const Register& reg) {
    return reg.name == "MYADDR" || reg.name == "MY_ADDR";
}

/// The names, the first twenty of them.
std::string names_of(const std::vector<Difference>& all) {
    constexpr std::size_t kMost = 20;
    std::string text;
    for (std::size_t i = 0; i < all.size() && i < kMost; ++i)
        text += (text.empty() ? "" : ", ") + std::string(all[i].reg->name);
    return all.size() > kMost ? text + fmt::format(" and {} more", all.size() - kMost) : text;
}

void look_at_model(Session& session, const ParameterSet& set, const Options& options) {
    const Model model = session.motor().model();
    if ((set.model == Model::mac800) != (model == Model::mac800))
        throw UserError(fmt::format("{} is of a {}, the motor is {}: their registers are not the same",
                                    options.file, registers::name_of(set.model),
                                    model == Model::mac800 ? "a MAC800" : "one of MAC50 to MAC141"));
    if (options.another) return;
    const bool known = set.model_is_known && !session.common().model.empty();
    if (known && set.model != model)
        throw UserError(
            fmt::format("{} is of a {}, the motor is a {}; --another-model if it is to have these values",
                        options.file, registers::name_of(set.model), registers::name_of(model)));
    const auto type = set.header.find("motor_type");
    const std::int64_t own = session.motor().read("MOTOR_TYPE");
    if (type != set.header.end() && type->second != fmt::format("{}", own))
        throw UserError(fmt::format(
            "{} is of a motor of type {}, this one's MOTOR_TYPE is {}; --another-model if it is to "
            "have these values",
            options.file, type->second, own));
}

/// What is to be written: what differs, without the address. Dangerous ones as the options say.
std::vector<Difference> to_write(Session& session, const ParameterSet& wanted, const ParameterSet& own,
                                 const Options& options) {
    std::vector<Difference> some;
    std::vector<Difference> dangerous;
    for (const Difference& one : differences(wanted, own)) {
        if (!one.left || is_address(*one.reg)) continue;
        (one.reg->dangerous ? dangerous : some).push_back(one);
    }
    if (dangerous.empty() || options.skip_dangerous) return some;
    if (!options.force)
        throw UserError(
            fmt::format("{}: these differ and may damage the motor or upset its control: {}; --force writes "
                        "them too, --skip-dangerous leaves them alone",
                        options.file, names_of(dangerous)));
    session.ask(fmt::format("These may damage the motor or upset its control: {}", names_of(dangerous)));
    some.insert(some.end(), dangerous.begin(), dangerous.end());
    return some;
}

void make_passive(Session& session, bool stop) {
    Motor& motor = session.motor();
    const std::int64_t mode = motor.read(registers::MODE_REG);
    if (mode == 0 || mode == 15) return;
    if (!stop)
        refuse(fmt::format("the motor is in {}: parameters change under way; stop it first, or say --stop",
                           mode_text(motor.model(), mode)));
    motor.master().init_mode(motor.address());
    const base::Instant end = motor.now() + base::Milliseconds{10'000};
    while (motor.read(registers::MODE_REG) != 0) {
        look_for_interruption();
        if (motor.now() >= end) refuse("the motor was told to stop and did not become passive within 10 s");
        session.pause(base::Milliseconds{50});
    }
}

[[noreturn]] void broke_off(const std::string& why, int exit_code, const std::vector<Difference>& all,
                            std::size_t done) {
    const std::vector<Difference> written(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(done));
    Json names = Json::array();
    for (const Difference& one : written) names.push_back(one.reg->name);
    const std::string next =
        done < all.size() ? fmt::format("; {} may have been written or not", all[done].reg->name) : "";
    throw command_line::Failure(exit_code,
                                fmt::format("{}; {} of {} were written{}{}", why, done, all.size(),
                                            written.empty() ? "" : ": " + names_of(written), next),
                                {{"written", names}, {"of", all.size()}});
}

std::int64_t whole_value(Session& session, const Difference& one) {
    const Model model = session.motor().model();
    const auto mask = static_cast<std::int32_t>(setting_bits(model, *one.reg));
    if (mask == -1) return *one.left;
    const std::int64_t now = session.motor().read(*one.reg);
    return (now & ~mask) | (*one.left & mask);
}

void write_all(Session& session, const std::vector<Difference>& all) {
    for (std::size_t done = 0; done < all.size(); ++done) {
        try {
            look_for_interruption();
            const Outcome outcome = change(session.motor(), *all[done].reg, whole_value(session, all[done]));
            if (!outcome.taken)
                broke_off(fmt::format("{} was not taken: {}", all[done].reg->name, outcome.why),
                          command_line::kRefused, all, done);
        } catch (const LineError& error) {
            broke_off(error.what(), command_line::kNoAnswer, all, done);
        } catch (const Interrupted& error) {
            broke_off(error.what(), command_line::kInterrupted, all, done);
        }
        session.progress(fmt::format("{} of {} registers", done + 1, all.size()));
    }
    session.progress("");
}

void verify(Session& session, const ParameterSet& wanted, const std::vector<Difference>& written) {
    const ParameterSet own = read_parameters(session.motor(), {}, goes_on);
    std::vector<Difference> wrong;
    for (const Difference& one : written) {
        if (own.values.at(one.reg->number) != wanted.values.at(one.reg->number)) wrong.push_back(one);
    }
    if (!wrong.empty())
        refuse(fmt::format("written, but read back these have another value: {}", names_of(wrong)));
}

void load(Common& common, const Options& options) {
    ParameterSet wanted = read_parameter_file(options.file, options.partial);
    Session session(common);
    look_at_model(session, wanted, options);
    const Model model = session.motor().model();
    const ParameterSet own = read_parameters(session.motor(), {}, goes_on);
    for (auto& [number, raw] : wanted.values)
        raw &= static_cast<std::int32_t>(setting_bits(model, *session.motor().find(number)));
    wanted.model = model;
    const auto all = to_write(session, wanted, own, options);
    if (!all.empty()) make_passive(session, options.stop);
    write_all(session, all);
    verify(session, wanted, all);
    Json names = Json::array();
    for (const Difference& one : all) names.push_back(one.reg->name);
    session.tell(
        all.empty()
            ? fmt::format("{}: the motor has all of it already", options.file)
            : fmt::format("{}: {} registers written and checked; they are in memory, `macreg flash save` "
                          "keeps them",
                          options.file, all.size()),
        {{"written", names}});
}

}  // namespace

void add_load(arguments::App& app, Common& common) {
    const auto options = std::make_shared<Options>();
    arguments::App& command =
        add_command(app, "load",
                    "Write a file of `dump` into the motor's memory. The whole file is checked first; only "
                    "what differs is written, and all of it is read back. The address stays");
    command.add_option("file", options->file, "The file")->required();
    command.add_flag("--stop", options->stop, "Stop the motor first if it is in a mode that moves it");
    command.add_flag("--force", options->force, "Write dangerous registers too; asks");
    command.add_flag("--skip-dangerous", options->skip_dangerous, "Leave dangerous registers as they are")
        ->excludes("--force");
    command.add_flag("--another-model", options->another,
                     "Take the file of another model or type of the same family");
    command.add_flag("--partial", options->partial, "Take a file that is marked as incomplete");
    command.callback([options, &common] { guard(common, [&] { load(common, *options); }); });
}

}  // namespace nplc::macreg::cli
