#include "cli/session.h"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>

#include "host/printable.h"
#include "host/terminal.h"
#include "macreg/change.h"
#include "macreg/values.h"
#include "registers/gateway.h"
#include "whole_files/whole_files.h"

namespace nplc::macreg::cli {

using mactalk_client::LineError;
using registers::Model;

namespace {

constexpr std::uint8_t kEveryone = 255;

constexpr unsigned kBriefAttempts = 2;
constexpr unsigned kBriefPatience = 150;  ///< ms

bool answers(mactalk_client::Master& master, std::uint8_t address, const Common& common) {
    mactalk_client::Master brief(
        master.wire(), {.baud = common.baud,
                        .patience = base::Milliseconds{std::min(common.patience_ms, kBriefPatience)},
                        .attempts = kBriefAttempts});
    try {
        static_cast<void>(brief.read(address, registers::PROG_VERSION));
        return true;
    } catch (const LineError& error) {
        if (error.kind() != LineError::Kind::no_answer) throw;
        return false;
    }
}

/// The only motor on the line reports its address itself; 255 is kept if it reports no usable one. Behind a
/// gateway the motor has the address of the gateway's setting.
std::uint8_t find_address(mactalk_client::Master& master, const Common& common) {
    if (common.address != 0) return static_cast<std::uint8_t>(common.address);
    const Model model = Motor::find_model(master, kEveryone);
    Motor everyone(master, kEveryone, model);
    const std::int64_t own = everyone.read(address_register(model));
    if (own < 1 || own > 254) return kEveryone;
    if (answers(master, static_cast<std::uint8_t>(own), common) || !everyone.is_behind_gateway())
        return static_cast<std::uint8_t>(own);
    namespace gw = registers::gateway;
    return static_cast<std::uint8_t>(
        master.read(gw::kDefaultAddress, gw::register_of(gw::Setting::motor_address)));
}

Model find_model(mactalk_client::Master& master, std::uint8_t address, const Common& common) {
    const Model found = Motor::find_model(master, address);
    const auto wanted = model_option(common);
    if (!wanted) return found;
    if ((*wanted == Model::mac800) != (found == Model::mac800))
        throw UserError(fmt::format(
            "--model {}: the motor with address {} says that it is {}; leave --model away", common.model,
            address, found == Model::mac800 ? "a MAC800" : "one of MAC50 to MAC141"));
    return *wanted;
}

/// A gateway whose motor link is down answers for its own registers only.
[[noreturn]] void nobody(mactalk_client::Master& master, const Common& common, const LineError& error) {
    namespace gw = registers::gateway;
    const bool silent = error.kind() == LineError::Kind::no_answer;
    Motor any(master, kEveryone, Model::mac140);
    if (silent && any.is_behind_gateway() &&
        (master.read(gw::kDefaultAddress, gw::STATUS) & gw::kLinkDelivers) == 0)
        throw LineError(error.kind(),
                        fmt::format("{}: a gateway answers, but its link to the motor does not work; "
                                    "`nanoctl status` tells more",
                                    master.wire().name()));
    if (!silent) throw LineError(error.kind(), error.what());
    if (common.address != 0 && common.address != kEveryone)
        throw LineError(
            error.kind(),
            fmt::format("{}; `macreg find` shows which addresses answer, and at which speed", error.what()));
    if (master.counters().stray_bytes > 0)
        throw LineError(
            error.kind(),
            fmt::format("{}: answers came that cannot be understood: several motors that answer at once "
                        "do that; name one with --address (`macreg find` shows them). With one motor "
                        "only: is the speed right?",
                        master.wire().name()));
    throw LineError(error.kind(),
                    std::string(error.what()) +
                        "; with several motors on the line name one with --address (`macreg find` "
                        "shows them)");
}

/// Errors in the command line are reported before anything is sent.
std::unique_ptr<host::ByteClient> open(const Common& common) {
    static_cast<void>(model_option(common));
    return command_line::open_with_password(common, registers::gateway::kDefaultAddress);
}

std::unique_ptr<host::ByteClient> open_for_stop(const Common& common) {
    static_cast<void>(model_option(common));
    try {
        return command_line::open_for_stop(common);
    } catch (const LineError& error) {
        throw command_line::Failure(
            command_line::kNotConfirmed,
            fmt::format("{}; the stop could not be sent: the motor may be moving", error.what()));
    }
}

/// As the gateway's settings say it; empty: there is none, or it does not answer.
std::optional<Model> model_at_gateway(mactalk_client::Master& master) {
    namespace gw = registers::gateway;
    Motor any(master, kEveryone, Model::mac140);
    if (!any.is_behind_gateway()) return std::nullopt;
    const std::uint8_t setting = gw::register_of(gw::Setting::motor_is_mac800);
    return master.read(gw::kDefaultAddress, setting) != 0 ? Model::mac800 : Model::mac140;
}

constexpr unsigned kStopsAtOnce = 2;

}  // namespace

void refuse(const std::string& text) {
    throw command_line::Failure(command_line::kRefused, text);
}

void refuse(const std::string& text, const Json& details) {
    throw command_line::Failure(command_line::kRefused, text, details);
}

std::optional<Model> model_option(const Common& common) {
    if (common.model.empty()) return std::nullopt;
    const auto model = registers::model_of(common.model);
    if (!model)
        throw UserError(
            fmt::format("--model {}: write MAC50, MAC95, MAC140, MAC141 or MAC800", common.model));
    return model;
}

std::vector<const registers::Register*> find_registers(Model model, const std::vector<std::string>& names) {
    std::vector<const registers::Register*> found;
    for (const std::string& name : names) {
        const NamedRegister named = find_register(model, name);
        if (named.reg == nullptr) throw UserError(named.error);
        found.push_back(named.reg);
    }
    return found;
}

Session::Session(const Common& common) : Session(common, open(common)) {
    find_motor();
}

/// A stop needs no password.
Session::Session(const Common& common, std::int64_t stop) : Session(common, open_for_stop(common)) {
    const auto model = model_option(common);
    const auto address = common.address != 0 ? static_cast<std::uint8_t>(common.address) : kEveryone;
    const auto failed = [](int exit_code, const std::string& why, const char* advice = "") {
        return command_line::Failure(exit_code,
                                     fmt::format("the stop was sent, but {}{}; {}", kMayMove, advice, why));
    };
    try {
        static_cast<void>(stop_unasked(master_, address, model, stop, kStopsAtOnce));
        command_line::give_password(common, registers::gateway::kDefaultAddress, *wire_);
        find_motor();
    } catch (const LineError& error) {
        const char* const advice = stop_once_more(error, address, stop)
                                       ? ""
                                       : "; a MAC800 takes it with --model MAC800 only, unless it answers";
        throw failed(command_line::kNotConfirmed, error.what(), advice);
    } catch (const mactalk_client::Ended& error) {
        throw failed(error.exit_code(), error.what());
    }
}

bool Session::stop_once_more(const LineError& error, std::uint8_t address, std::int64_t stop) {
    auto model = model_option(common_);
    if (error.kind() != LineError::Kind::no_answer) return model.has_value();
    try {
        static_cast<void>(stop_unasked(master_, address, model, stop, kStopsAtOnce));
        if (model) return true;
        model = model_at_gateway(master_);
        if (model == Model::mac800)
            static_cast<void>(stop_unasked(master_, address, model, stop, kStopsAtOnce));
    } catch (const LineError&) {  // the first error is told
    }
    return model.has_value();
}

Session::Session(const Common& common, std::unique_ptr<host::ByteClient> wire)
    : common_(common),
      wire_(std::move(wire)),
      master_(*wire_, {.baud = common.baud,
                       .patience = base::Milliseconds{common.patience_ms},
                       .attempts = common.attempts}) {}

void Session::find_motor() {
    try {
        const std::uint8_t address = find_address(master_, common_);
        motor_ = std::make_unique<Motor>(master_, address, find_model(master_, address, common_));
    } catch (const LineError& error) {
        nobody(master_, common_, error);
    }
}

std::string Session::model_name() const {
    const bool known = !common_.model.empty() || motor_->model() == Model::mac800;
    return known ? std::string(registers::name_of(motor_->model())) : "MAC50-141";
}

void remark(const Common& common, const std::string& text) {
    if (!common.json) host::complain(common.program + ": " + text);
}

void ask(const Common& common, const std::string& what) {
    if (common.yes) return;
    if (!host::is_terminal(stdin) || common.json)
        throw UserError(what + "; nobody is there to be asked: say --yes if you mean it");
    fmt::print(stderr, "{}. Type yes to go on: ", what);
    std::fflush(stderr);
    while (!host::input_within(base::Milliseconds{100})) look_for_interruption();
    std::string answer;
    std::getline(std::cin, answer);
    look_for_interruption();
    if (answer.ends_with('\r')) answer.pop_back();
    if (answer != "yes") throw UserError("not confirmed, nothing was changed");
}

std::string output_file(const std::string& option, bool force) {
    if (option.empty()) throw UserError("-o: write a file's name, or - for standard output");
    if (option == "-") return {};
    if (const std::string why = whole_files::why_kept(option); !why.empty() && !force) throw UserError(why);
    return option;
}

std::string counted(std::size_t count, const std::string& what) {
    return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

void tell_findings(const Common& common, const std::vector<Finding>& findings, const char* key,
                   const std::function<ShownValue(std::string_view name)>& value_of) {
    std::string text;
    Json list = Json::array();
    for (const Finding& one : findings) {
        std::string values;
        Json documents = Json::array();
        for (const std::string_view name : one.sources) {
            ShownValue value = value_of(name);
            values += fmt::format("{}{} = {}", values.empty() ? "" : ", ", name, value.text);
            documents.push_back(std::move(value.document));
        }
        text += fmt::format("{}{}. {}\n", text.empty() ? "" : "\n\n", list.size() + 1, one.sentence);
        if (!values.empty()) text += fmt::format("   {}\n", values);
        text += fmt::format("   -> {}", one.remedy);
        list.push_back({{"code", one.code},
                        {"severity", name_of(one.severity)},
                        {"sentence", one.sentence},
                        {key, documents},
                        {"remedy", one.remedy}});
    }
    command_line::tell(common, text, {{"findings", list}});
}

void Search::run(std::uint32_t this_speed, std::span<const std::uint32_t> speeds,
                 const std::function<void(std::uint32_t baud)>& at) {
    if (options_.only_this) return at(this_speed);
    for (const std::uint32_t baud : speeds) {
        if (all_.empty() || options_.every) at(baud);
    }
}

void Search::add(const std::string& line, Json document) {
    text_ += (text_.empty() ? "" : "\n") + line;
    all_.push_back(std::move(document));
}

void Search::tell(const char* key, const char* of_noise, const char* of_silence) const {
    progress(common_, "");
    if (all_.empty()) throw command_line::Failure(command_line::kNoAnswer, noise_ ? of_noise : of_silence);
    command_line::tell(common_, text_, {{key, all_}});
}

void add_speed_options(arguments::App& command, Search::Speeds& speeds) {
    command.add_flag("--every-speed", speeds.every,
                     "Go on with the other speeds when one has been answered at");
    command.add_flag("--this-speed", speeds.only_this, "Only the speed of --baud");
}

Json value_document(const registers::Register& reg, Model model, std::int64_t raw) {
    return {{"name", reg.name}, {"number", reg.number}, {"raw", raw}, {"value", value_text(reg, model, raw)}};
}

}  // namespace nplc::macreg::cli
