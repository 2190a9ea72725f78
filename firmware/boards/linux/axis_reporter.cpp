#include "axis_reporter.h"

#include <array>
#include <optional>
#include <utility>

#include "base/bytes.h"
#include "faces/set_point_book.h"
#include "log_messages.h"

namespace nplc::boards {
namespace {

using registers::gateway::Event;

bool is_of_recipe(Event event) {
    return event == Event::recipe_loaded || event == Event::recipe_saved || event == Event::recipe_deleted;
}

/// Names with old and new values, which the log only counts.
std::string changes_of(const gateway::EventLog::Entry& entry, gateway::Controller& controller) {
    const auto event = static_cast<Event>(entry.event);
    const bool changes = event == Event::set_points_changed || event == Event::recipe_loaded;
    if (!changes && event != Event::set_points_dropped && event != Event::recipe_saved) return {};
    const faces::SetPointBook book = faces::book_of(controller);
    if (event == Event::set_points_dropped) return set_points::names_of(book.record, entry.detail);
    std::string text =
        changes ? set_points::changes_text(book.changes, book.record, entry.milliseconds) : std::string();
    const set_points::Recipe* recipe = is_of_recipe(event) ? book.find_recipe(entry.detail & 0xFF) : nullptr;
    if (recipe == nullptr) return text;
    return "'" + recipe->name + "'" + (text.empty() ? "" : ", " + text);
}

/// The client that is the operator; every change needs one.
std::string client_of(const gateway::EventLog::Entry& entry, const faces::Sitter* holder) {
    using registers::gateway::Origin;
    const auto event = static_cast<Event>(entry.event);
    if (holder == nullptr || (event != Event::set_points_changed && !is_of_recipe(event))) return {};
    const auto origin = static_cast<Origin>(entry.detail >> 8);
    const bool by_person = origin == Origin::user_port || origin == Origin::panel;
    return by_person == (holder->side == faces::Side::person) ? holder->name : std::string();
}

bool is_of_store(const gateway::EventLog::Entry& entry) {
    return entry.event == static_cast<std::uint8_t>(Event::store_damaged) ||
           entry.event == static_cast<std::uint8_t>(gateway::SafeReason::bad_settings);
}

}  // namespace

void AxisReporter::start(base::Instant now) {
    events_.restart();
    drops_.restart();
    force_messages_.restart();
    stop_messages_.restart();
    tell_silence_at_ = now + StopMessages::kFirstAnswer;
}

void AxisReporter::report(gateway::Controller& controller, MotorPart& motor, const faces::Sitter* holder,
                          base::Instant now) {
    report_events(controller, holder);
    report_stop(controller, holder, now);
    for (const LogMessage& message : motor.news())
        journal_.write(message.level, JournalEvent::drive, message.text);
    report_link(motor, now);
}

void AxisReporter::report_events(gateway::Controller& controller, const faces::Sitter* holder) {
    events_.look(controller.sequence().log(), [&](const gateway::EventLog::Entry& entry) {
        if (!has_store_ && is_of_store(entry)) return;
        stop_is_logged_ = stop_is_logged_ || static_cast<Event>(entry.event) == Event::stop_confirmed;
        const bool is_link_up = static_cast<Event>(entry.event) == Event::link_up;
        if (is_link_up && !link_messages_.writes_whole()) return;
        std::optional<LogMessage> words = force_messages_.message(entry, controller.sequence().forces());
        if (!words) return;
        LogMessage message = std::move(*words);
        if (const std::string changes = changes_of(entry, controller); !changes.empty())
            message.text += ": " + changes;
        JournalFields fields = fields_of(entry);
        if (const std::string client = client_of(entry, holder); !client.empty()) {
            message.text += "; " + client;
            fields.push_back({"CLIENT", client});
        }
        journal_.write(message.level, event_of(entry), message.text, fields);
        if (static_cast<Event>(entry.event) == Event::table_activated) report_drops(controller);
    });
    drops_.look(controller);
}

void AxisReporter::report_drops(gateway::Controller& controller) {
    for (const set_points::Dropped& one : drops_.exchanged(controller)) {
        journal_.write(LogLevel::warning, JournalEvent::set_point_dropped,
                       "set-points: " + set_points::text_of(one),
                       {{"SET_POINT", one.name}, {"REASON", std::string(set_points::key_of(one.why))}});
    }
}

void AxisReporter::report_stop(gateway::Controller& controller, const faces::Sitter* holder,
                               base::Instant now) {
    const bool is_unconfirmed = controller.sequence().stop_unconfirmed();
    std::array<std::uint8_t, 4> command{};
    if (is_unconfirmed || stop_messages_.is_open())
        controller.registers().read(registers::gateway::COMMAND, command, now);
    const auto message =
        stop_messages_.look({.is_unconfirmed = is_unconfirmed,
                             .link_is_usable = motor::link_is_usable(controller.motor().link()),
                             .is_logged = std::exchange(stop_is_logged_, false),
                             .last_command = base::load_u32(command.data()),
                             .operator_name = holder == nullptr ? std::string_view() : holder->name},
                            now);
    if (message) journal_.write(message->level, message->event, message->text);
}

void AxisReporter::report_link(MotorPart& motor, base::Instant now) {
    const motor::Link link = motor.driver().link();
    if (motor::link_is_usable(link)) tell_silence_at_ = base::kNever;
    if (now >= tell_silence_at_) {
        tell_silence_at_ = base::kNever;
        journal_.write(LogLevel::warning, JournalEvent::motor_silent, motor.silence_in_words(),
                       cause_field(gateway::SafeReason::link_down));
    }
    if (const auto count = link_messages_.count(now))
        journal_.write(LogLevel::warning, JournalEvent::motor_lost, *count,
                       cause_field(gateway::SafeReason::link_down));
    if (motor::link_is_usable(link) == motor::link_is_usable(told_link_)) return;
    told_link_ = link;
    if (motor::link_is_usable(link))
        link_messages_.back();
    else
        link_messages_.lost(now);
    if (!link_messages_.writes_whole()) return;
    if (motor::link_is_usable(link))
        journal_.write(LogLevel::notice, JournalEvent::motor_answers,
                       "the motor answers on " + motor.line_in_words());
    else
        journal_.write(LogLevel::warning, JournalEvent::motor_lost, motor.loss_in_words(),
                       cause_field(gateway::SafeReason::link_down));
}

}  // namespace nplc::boards
