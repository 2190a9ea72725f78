#include <fmt/format.h>

#include "cli/session.h"
#include "macreg/change.h"
#include "macreg/parameters.h"
#include "macreg/service.h"
#include "macreg/values.h"

namespace nplc::macreg::cli {
namespace {

using registers::Model;
using registers::Register;

struct LoadArguments {
    std::string file;
    bool stop = false;
    bool force = false;
    bool skip_dangerous = false;
    bool partial = false;
    bool another = false;
};

/// The names, at most twenty of them.
std::string names_of(const std::vector<Difference>& all) {
    constexpr std::size_t kMost = 20;
    std::string text;
    for (std::size_t i = 0; i < all.size() && i < kMost; ++i)
        text += (text.empty() ? "" : ", ") + std::string(all[i].reg->name);
    return all.size() > kMost ? text + fmt::format(" and {} more", all.size() - kMost) : text;
}

void look_at_model(Session& session, const ParameterSet& set, const LoadArguments& options) {
    const Model model = session.motor().model();
    if ((set.model == Model::mac800) != (model == Model::mac800))
        throw UserError(fmt::format("{} is of {}, the motor is {}: their registers are not the same",
                                    options.file, model_words(set),
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
        throw UserError(
            fmt::format("{} is of a motor of type {}, this one's MOTOR_TYPE is {}; --another-model if it is "
                        "to have these values",
                        options.file, type->second, own));
}

/// The differing parameters, without the address; dangerous ones if the options allow them.
std::vector<Difference> to_write(Session& session, const ParameterSet& wanted, const ParameterSet& own,
                                 const LoadArguments& options) {
    std::vector<Difference> some;
    std::vector<Difference> dangerous;
    for (const Difference& one : differences(wanted, own)) {
        if (!one.left || one.reg->number == address_register(session.motor().model()).number) continue;
        const bool may_harm = !danger(session.motor().model(), *one.reg, *one.left).empty();
        (may_harm ? dangerous : some).push_back(one);
    }
    const std::string limits = limits_danger(read_limits(session.motor(), wanted.values), wanted.values);
    if (!limits.empty() && !options.force)
        throw UserError(fmt::format("{}: {}; --force writes it all the same", options.file, limits));
    if (!limits.empty()) session.ask(limits);
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

/// Writes the differences; on a failure it reports what has been written.
class Writer {
  public:
    Writer(Session& session, const LoadArguments& options, const std::vector<Difference>& all)
        : session_(session), options_(options), all_(all) {}

    void run(const ParameterSet& wanted) {
        try {
            if (all_.empty()) return;
            make_passive();
            for (; done_ < all_.size(); ++done_) write(all_[done_]);
            session_.progress("");
            verify(wanted);
        } catch (const command_line::Failure&) {
            throw;
        } catch (const mactalk_client::Ended& error) {
            broke_off(error.what(), error.exit_code());
        }
    }

  private:
    void make_passive() {
        Motor& motor = session_.motor();
        const std::int64_t mode = motor.read(registers::MODE_REG);
        if (is_passive(mode)) return;
        if (!options_.stop)
            refuse(
                fmt::format("the motor is in {}: parameters change under way; stop it first, or say --stop",
                            mode_text(motor.model(), mode)));
        stop_motor(motor, goes_on, trail_);
    }

    void write(const Difference& one) {
        look_for_interruption();
        const std::int64_t value = whole_value(one);
        in_doubt_ = true;
        const ChangeResult outcome = change(session_.motor(), *one.reg, value);
        in_doubt_ = false;
        if (!outcome.taken)
            broke_off(fmt::format("{} was not taken: {}", one.reg->name, outcome.why),
                      command_line::kRefused);
        session_.progress(fmt::format("{} of {} registers", done_ + 1, all_.size()));
    }

    std::int64_t whole_value(const Difference& one) {
        const Model model = session_.motor().model();
        const auto mask = static_cast<std::int32_t>(setting_bits(model, *one.reg));
        if (mask == -1) return *one.left;
        const std::int64_t now = session_.motor().read(*one.reg);
        return (now & ~mask) | (*one.left & mask);
    }

    void verify(const ParameterSet& wanted) {
        const ParameterSet own = read_parameters(session_.motor(), {}, goes_on);
        std::vector<Difference> wrong;
        for (const Difference& one : all_) {
            if (own.values.at(one.reg->number) != wanted.values.at(one.reg->number)) wrong.push_back(one);
        }
        if (!wrong.empty())
            refuse(fmt::format("written, but read back these have another value: {}", names_of(wrong)));
    }

    [[noreturn]] void broke_off(const std::string& why, int exit_code) {
        session_.progress("");
        const std::vector<Difference> written(all_.begin(),
                                              all_.begin() + static_cast<std::ptrdiff_t>(done_));
        Json names = Json::array();
        for (const Difference& one : written) names.push_back(one.reg->name);
        std::string text = fmt::format("{}; ", why);
        if (done_ == all_.size())
            text += "all of it was written, but not compared: see `macreg diff`";
        else
            text += fmt::format("{} of {} {} written{}", done_ == 0 ? "none" : fmt::format("{}", done_),
                                counted(all_.size(), "register"), done_ == 1 ? "was" : "were",
                                written.empty() ? "" : ": " + names_of(written));
        if (in_doubt_) text += fmt::format("; {} may have been written or not", all_[done_].reg->name);
        if (!trail_.ran_in.empty()) text += "; " + trail_.stop_words();
        throw command_line::Failure(exit_code, text + "; the flash is as it was",
                                    {{"written", names}, {"of", all_.size()}, {"stopped", trail_.stopped}});
    }

    Session& session_;
    const LoadArguments& options_;
    const std::vector<Difference>& all_;
    std::size_t done_ = 0;
    bool in_doubt_ = false;  ///< the pending write may have reached the motor
    Trail trail_;
};

ParameterSet read_own(Session& session) {
    try {
        return read_parameters(session.motor(), {}, goes_on);
    } catch (const mactalk_client::Ended& error) {
        throw command_line::Failure(error.exit_code(), fmt::format("{}; nothing was written", error.what()));
    }
}

/// In the file but not written: the motor keeps its own address.
std::string left_alone(const LoadArguments& options, const ParameterSet& wanted, const ParameterSet& own) {
    for (const Difference& one : differences(wanted, own)) {
        if (one.left && one.right && one.reg == &address_register(own.model))
            return fmt::format("{} stays {}: load leaves the address alone, {} has {}", one.reg->name,
                               *one.right, options.file, *one.left);
    }
    return {};
}

/// A file of another axis is usually a mistake.
void look_at_address(Session& session, const ParameterSet& wanted, const LoadArguments& options) {
    const auto address = wanted.header.find("address");
    const unsigned own = session.motor().address();
    if (address == wanted.header.end() || address->second == fmt::format("{}", own)) return;
    session.remark(fmt::format("{} was read from a motor with address {}, this one has {}", options.file,
                               address->second, own));
}

void load(Common& common, const LoadArguments& arguments) {
    LoadArguments options = arguments;
    ParameterSet wanted = read_parameter_file(options.file, options.partial);
    if (options.file == "-") options.file = "standard input";
    Session session(common);
    look_at_model(session, wanted, options);
    look_at_address(session, wanted, options);
    const Model model = session.motor().model();
    const ParameterSet own = read_own(session);
    for (auto& [number, raw] : wanted.values)
        raw &= static_cast<std::int32_t>(setting_bits(model, *session.motor().find(number)));
    wanted.model = model;
    auto all = to_write(session, wanted, own, options);
    order_limits(read_limits(session.motor(), wanted.values), wanted.values, all);
    const std::string address = left_alone(options, wanted, own);
    Writer(session, options, all).run(wanted);
    if (!address.empty()) session.remark(address);
    Json names = Json::array();
    for (const Difference& one : all) names.push_back(one.reg->name);
    session.tell(all.empty()
                     ? fmt::format("{}: the motor has all {}already", options.file,
                                   address.empty() ? "of it " : "else ")
                     : fmt::format("{}: {} written and checked; {} in memory, `macreg flash save` keeps {}",
                                   options.file, counted(all.size(), "register"),
                                   all.size() == 1 ? "it is" : "they are", all.size() == 1 ? "it" : "them"),
                 {{"written", names}, {"left_alone", address}});
}

}  // namespace

void add_load(arguments::App& app, Common& common) {
    auto [command, options] =
        add_command(app, common, "load",
                    "Write a file of `dump` into the motor's memory. The whole file is checked first; only "
                    "what differs is written, and all of it is read back. The address stays",
                    load);
    command.add_option("file", options.file, "The file; - is standard input")->required();
    command.add_flag("--stop", options.stop, "Stop the motor first if it is in a mode that moves it");
    command.add_flag("--force", options.force, "Write dangerous registers too; asks");
    command.add_flag("--skip-dangerous", options.skip_dangerous, "Leave dangerous registers as they are")
        ->excludes("--force");
    command.add_flag("--another-model", options.another,
                     "Take the file of another model or type of the same family");
    command.add_flag("--partial", options.partial, "Take a file that is marked as incomplete");
}

}  // namespace nplc::macreg::cli
