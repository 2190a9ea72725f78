#include "request.h"

#include <fmt/format.h>

#include <array>

#include "base/json_depth.h"
#include "panel/names.h"
#include "registers/gateway.h"

namespace nplc::panel {
namespace {

using faces::Command;
namespace own = registers::gateway;

constexpr std::int64_t kLargestId = std::int64_t{1} << 53;
constexpr std::array kCommands{
    own::Command::run,       own::Command::stop,         own::Command::safe,     own::Command::scan,
    own::Command::step,      own::Command::hold,         own::Command::reset,    own::Command::keep_settings,
    own::Command::clear_log, own::Command::upload_abort, own::Command::activate, own::Command::give_up_stop};

/// Makes a client's text safe for a message.
std::string shown(std::string_view text) {
    std::string result;
    for (const char c : text.substr(0, 40)) result += static_cast<unsigned char>(c) < 0x20 ? '?' : c;
    return result;
}

/// By its name, or reset_error, which is the motor's.
Asked named_command(const Request& request, base::Instant now) {
    const std::string name = request.text("name");
    if (name == "reset_error") return {Command::reset_error(now), {}};
    for (const own::Command command : kCommands) {
        if (own::name_of(command) == name) return {Command::of(command, now), {}};
    }
    return {{}, fmt::format("there is no command \"{}\"; see PROTOCOL.md", shown(name))};
}

/// By name or number.
const own::Row* own_register(const Request& request) {
    if (const auto number = request.whole("register"); number && *number >= 0 && *number < 256)
        return own::find(static_cast<std::uint8_t>(*number));
    return own::find(request.text("register"));
}

std::optional<std::uint32_t> value_of(const Request& request) {
    const auto value = request.whole("value");
    if (!value || *value < INT32_MIN || *value > UINT32_MAX) return std::nullopt;
    return static_cast<std::uint32_t>(*value);
}

Asked own_write(const Request& request, base::Instant now) {
    const own::Row* row = own_register(request);
    if (row == nullptr)
        return {{}, "\"register\" must be the name or number of one of the gateway's registers"};
    // COMMAND and uploads have requests of their own: not accepted as plain writes.
    if (row->number == own::COMMAND || row->number == own::TABLE_DATA)
        return {{}, fmt::format("{} is not written like this; use \"command\" or \"upload\"", row->name)};
    const auto value = value_of(request);
    if (!value) return {{}, "\"value\" must be a whole number of 32 bits"};
    const auto number = request.whole("register").value_or(row->number);
    return {Command::own(static_cast<std::uint8_t>(number), *value, now), {}};
}

Asked motor_access(const Request& request, registers::Model model, base::Instant now) {
    const auto number = request.whole("register");
    const registers::Register* reg = number && *number > 0 && *number < 256
                                         ? registers::find(model, static_cast<std::uint8_t>(*number))
                                         : registers::find(model, request.text("register"));
    if (reg == nullptr)
        return {{},
                fmt::format("\"register\" must be the name or number of a register of a {}",
                            registers::name_of(model))};
    const bool is_long = registers::is_32_bit(reg->format) || model == registers::Model::mac800;
    if (request.what == "motor_read") return {Command::motor_read(reg->number, is_long, now), {}};
    const auto value = request.whole("value");
    if (!value || *value < reg->min || *value > reg->max)
        return {
            {},
            fmt::format("\"value\" of {} must be a whole number {} to {}", reg->name, reg->min, reg->max)};
    return {Command::motor_write(reg->number, is_long, static_cast<std::uint32_t>(*value), now), {}};
}

}  // namespace

Request Request::read(std::string_view text) {
    Request request;
    if (base::is_deeper(text, kDeepestJson)) {
        request.error = "its lists and objects lie too deep in each other";
        return request;
    }
    request.body = nlohmann::json::parse(text, nullptr, false);
    if (request.body.is_discarded()) {
        request.error = "this is no JSON";
        return request;
    }
    if (!request.body.is_object()) {
        request.error = "a message must be a JSON object";
        return request;
    }
    if (const auto id = request.whole("id"); id && *id >= 0 && *id <= kLargestId)
        request.id = static_cast<std::uint64_t>(*id);
    request.what = request.text("do");
    if (!request.id) request.error = "\"id\" must be a whole number";
    if (request.what.empty()) request.error = "\"do\" must say what is wanted";
    return request;
}

std::string Request::text(const char* name) const {
    const auto found = body.find(name);
    return found != body.end() && found->is_string() ? found->get<std::string>() : std::string();
}

std::optional<std::int64_t> Request::whole(const char* name) const {
    const auto found = body.find(name);
    if (found == body.end() || !found->is_number_integer()) return std::nullopt;
    if (found->is_number_unsigned() && found->get<std::uint64_t>() > INT64_MAX) return std::nullopt;
    return found->get<std::int64_t>();
}

std::optional<double> Request::number(const char* name) const {
    const auto found = body.find(name);
    if (found == body.end() || !found->is_number()) return std::nullopt;
    return found->get<double>();
}

bool Request::flag(const char* name) const {
    const auto found = body.find(name);
    return found != body.end() && found->is_boolean() && found->get<bool>();
}

Asked command_of(const Request& request, registers::Model model, base::Instant now) {
    if (request.what == "command") return named_command(request, now);
    if (request.what == "write") return own_write(request, now);
    if (request.what == "motor_read" || request.what == "motor_write")
        return motor_access(request, model, now);
    Command command;
    command.origin = now;
    using Kind = Command::Kind;
    const Kind take = request.flag("take_over") ? Kind::take_over_seat : Kind::take_seat;
    command.kind = request.what == "leave" ? Kind::leave_seat : take;
    return {command, {}};
}

}  // namespace nplc::panel
