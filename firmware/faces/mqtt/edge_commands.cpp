// Commands from hosts.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "edge_node.h"
#include "set_points/request.h"
#include "set_points/values.h"

namespace nplc::mqtt {

namespace gw = registers::gateway;
using faces::Result;

namespace {

bool is_true(const Metric& metric) {
    const auto* flag = std::get_if<bool>(&metric.value);
    return flag != nullptr && *flag;
}

/// As the host wrote it; a command without its folder, as one that was taken.
std::string shown_name(const Metric& metric) {
    constexpr std::size_t kLongestName = 64;
    if (metric.name.empty()) return fmt::format("alias {}", metric.alias.value_or(0));
    const std::size_t begin = metric.name.starts_with(kCommand) ? kCommand.size() : 0;
    return metric.name.substr(begin, kLongestName);
}

std::optional<double> number_in(const Metric& metric) {
    if (const auto* real = std::get_if<double>(&metric.value)) return *real;
    if (const auto* whole = std::get_if<std::int64_t>(&metric.value)) return static_cast<double>(*whole);
    return std::nullopt;
}

}  // namespace

void EdgeNode::receive(const Incoming& message, const Moment& moment) {
    if (is_host_state(message.topic)) return take_host_state(message.payload);
    const auto payload = decode(message.payload);
    if (!payload || !is_born_) return;
    if (message.topic == topic("NCMD")) {
        for (const Metric& metric : payload->metrics) {
            const bool is_rebirth =
                metric.name == kRebirth || (metric.name.empty() && metric.alias == kRebirthAlias);
            if (is_rebirth && is_true(metric) && !message.is_retained) wants_rebirth_ = true;
        }
        return;
    }
    for (std::size_t i = 0; i < devices_.size(); ++i) {
        const bool is_meant = message.topic == topic("DCMD", devices_[i].axis->name());
        // A dead device's axis may only not have answered for a while.
        if (is_meant && (devices_[i].is_born || stop_in(i, *payload) != nullptr))
            take_device_command(i, *payload, message, moment.milliseconds);
    }
}

void EdgeNode::refuse(Device& device, const std::string& what, Result result, const std::string& text) {
    device.command = what;
    device.result = static_cast<std::int64_t>(result);
    device.result_text = text.empty() ? std::string(gw::describe(result)) : text;
    device.result_changed = true;
    device.command_id = 0;
}

void EdgeNode::submit(Device& device, const std::string& what, const faces::Command& command) {
    const auto id = device.client->submit(command);
    if (!id) return refuse(device, what, Result::busy);
    device.command = what;
    device.command_id = *id;
    device.stop_waits = command.is_stop();
    device.sets_values = command.reg == gw::SET_POINT_WRITE;
}

/// Notes the timestamp; or why a command is not carried out that is retained, may have waited in a queue, or
/// is repeated. A stop may be older than the last command, which another host with another clock may have
/// sent.
std::string EdgeNode::take_timestamp(Device& device, const Given& given, bool stops) {
    const auto limit = static_cast<std::uint64_t>(options_.command_age.count());
    const bool is_ahead = given.timestamp > given.now;
    const std::uint64_t apart = is_ahead ? given.timestamp - given.now : given.now - given.timestamp;
    if (given.message.is_retained)
        return "the message is retained, and may be old; send it without `retain`; nothing was done";
    if (given.timestamp == 0)
        return "the message has no timestamp, and may be old; send one with each command; nothing was done";
    if (apart > limit)
        return fmt::format(
            "the timestamp is {}.{:03} s {} the gateway's clock, and command_age allows {} ms: {}; let host "
            "and "
            "gateway follow NTP; nothing was done",
            apart / 1'000, apart % 1'000, is_ahead ? "ahead of" : "behind", limit,
            is_ahead ? "one of the clocks is wrong" : "it waited on its way, or a clock is wrong");
    if (!stops && given.timestamp <= device.last_command)
        return "the timestamp is not later than that of the last command, so it may be a repeated message or "
               "come from a host whose clock is behind another's; nothing was done";
    device.last_command = std::max(device.last_command, given.timestamp);
    return {};
}

/// One command per message, or values of set-points, which are one change. A stop is carried out whatever
/// else the message has, which is then not done.
void EdgeNode::take_device_command(std::size_t index, const Payload& payload, const Incoming& message,
                                   std::uint64_t milliseconds) {
    const auto given = [&](const Metric& metric) {
        return Given{message, metric.timestamp.value_or(payload.timestamp.value_or(0)), milliseconds};
    };
    if (const Metric* stop = stop_in(index, payload)) return take_command(index, *stop, given(*stop));
    std::vector<const Metric*> values;
    std::vector<const Metric*> commands;
    for (const Metric& metric : payload.metrics) {
        if (metric.name.starts_with(kSetPoints) || set_point_of(index, metric) || is_of_recipe(index, metric))
            values.push_back(&metric);
        else if (is_true(metric))
            commands.push_back(&metric);
    }
    if (values.empty() && commands.empty()) return refuse_what_is_none(index, payload);
    if (commands.size() > 1)
        return refuse(devices_[index], shown_name(*commands.front()), Result::bad_value,
                      "more than one command in one message; nothing was done");
    if (values.empty()) return take_command(index, *commands.front(), given(*commands.front()));
    if (commands.empty()) return take_set_points(index, values, given(*values.front()));
    refuse(devices_[index], "Set Points", Result::bad_value,
           "a command and values in one message; nothing was done");
}

/// Something else than a false, with which hosts take a command back.
void EdgeNode::refuse_what_is_none(std::size_t index, const Payload& payload) {
    for (const Metric& metric : payload.metrics) {
        if (std::holds_alternative<bool>(metric.value)) continue;
        return refuse(
            devices_[index], shown_name(metric), Result::bad_value,
            "neither a command with the value true, nor a set-point of the table; nothing was done");
    }
}

std::optional<gw::Command> EdgeNode::allowed_command(std::size_t index, const Metric& metric) const {
    for (std::size_t place = 0; place < options_.commands.size(); ++place) {
        const gw::Command command = options_.commands[place];
        const bool is_meant = metric.name.empty()
                                  ? metric.alias == alias_of(index, kCommandAlias + place)
                                  : metric.name == fmt::format("{}{}", kCommand, gw::name_of(command));
        if (is_meant) return command;
    }
    return std::nullopt;
}

const Metric* EdgeNode::stop_in(std::size_t index, const Payload& payload) const {
    constexpr std::array kStrongestFirst{gw::Command::safe, gw::Command::stop, gw::Command::hold};
    for (const gw::Command wanted : kStrongestFirst) {
        for (const Metric& metric : payload.metrics) {
            if (is_true(metric) && allowed_command(index, metric) == wanted) return &metric;
        }
    }
    return nullptr;
}

void EdgeNode::take_command(std::size_t index, const Metric& metric, const Given& given) {
    Device& device = devices_[index];
    const auto allowed = allowed_command(index, metric);
    if (!allowed || !device.client)
        return refuse(device, shown_name(metric), Result::not_allowed,
                      "it is none of the `commands` that [mqtt] allows");
    const auto order = faces::Command::of(*allowed, given.message.arrived);
    if (const std::string why = take_timestamp(device, given, order.is_stop()); !why.empty())
        return refuse(device, std::string(gw::name_of(*allowed)), Result::too_late, why);
    submit(device, std::string(gw::name_of(*allowed)), order);
}

std::optional<std::size_t> EdgeNode::set_point_of(std::size_t index, const Metric& metric) const {
    const std::vector<Item>& items = devices_[index].items;
    for (std::size_t i = devices_[index].points; i < items.size(); ++i) {
        const bool is_meant =
            metric.name.empty() ? metric.alias == alias_of(index, i) : metric.name == items[i].name;
        if (is_meant) return items[i].set_point;
    }
    return std::nullopt;
}

bool EdgeNode::is_of_recipe(std::size_t index, const Metric& metric) const {
    const std::vector<Item>& items = devices_[index].items;
    if (!metric.name.empty()) return metric.name == kRecipe;
    return items.size() > devices_[index].points && metric.alias == alias_of(index, items.size() - 1);
}

/// All values are one change, carried out as a whole or not at all; or one recipe is loaded.
void EdgeNode::take_set_points(std::size_t index, const std::vector<const Metric*>& metrics,
                               const Given& given) {
    Device& device = devices_[index];
    const set_points::Record& record = device.book->record;
    std::vector<set_points::NewValue> values;
    const set_points::Recipe* recipe = nullptr;
    for (const Metric* metric : metrics) {
        const auto number = number_in(*metric);
        const auto place = set_point_of(index, *metric);
        const std::string name =
            place ? fmt::format("{}{}", kSetPoints, record.values[*place].name) : shown_name(*metric);
        if (is_of_recipe(index, *metric)) {
            if (!options_.recipes || !device.client)
                return refuse(device, name, Result::not_allowed, "`recipes` of [mqtt] does not allow it");
            const bool is_whole = number && *number >= 1 && *number <= 255 && std::trunc(*number) == *number;
            if (is_whole) recipe = device.book->find_recipe(static_cast<std::size_t>(*number));
            if (recipe == nullptr) return refuse(device, name, Result::no_recipe);
            continue;
        }
        if (!place) return refuse(device, name, Result::no_register, "the table has no such set-point");
        if (!options_.may_set(record.values[*place].name) || !device.client)
            return refuse(device, name, Result::not_allowed,
                          "it is none of the `set_points` that [mqtt] allows");
        const set_points::SetPoint& point = record.values[*place];
        const auto steps = number ? set_points::steps_of(point, *number) : std::nullopt;
        const auto before = std::find_if(values.begin(), values.end(),
                                         [&](const auto& value) { return value.index == *place; });
        if (!number || before != values.end()) return refuse(device, name, Result::bad_value);
        if (point.kind == set_points::ValueKind::counter && std::trunc(*number) != *number &&
            std::isfinite(*number))
            return refuse(device, name, Result::bad_value,
                          fmt::format("{} is no whole number; nothing was changed", *number));
        if (!steps)
            return refuse(
                device, name, Result::out_of_range,
                faces::describe_refusal(*device.book, {.result = Result::out_of_range,
                                                       .detail = static_cast<std::uint16_t>(*place)}));
        values.push_back({*place, *steps});
    }
    const std::string what = metrics.size() == 1 && recipe == nullptr
                                 ? fmt::format("{}{}", kSetPoints, record.values[values.front().index].name)
                             : recipe != nullptr ? std::string(kRecipe)
                                                 : "Set Points";
    if (recipe != nullptr && metrics.size() != 1)
        return refuse(device, what, Result::bad_value,
                      "a recipe and values in one message; nothing was done");
    if (const std::string why = take_timestamp(device, given, false); !why.empty())
        return refuse(device, what, Result::too_late, why);
    const auto request = recipe == nullptr
                             ? set_points::encode_request(record, gw::SetPointRequest::change, values)
                             : set_points::encode_request(record, gw::SetPointRequest::load_recipe, {},
                                                          {.number = recipe->number, .name = recipe->name});
    submit(device, what, faces::Command::set_points(request, gw::Origin::mqtt, given.message.arrived));
}

}  // namespace nplc::mqtt
