#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

namespace nplc::boards {

/// Field EVENT of messages that do not come from an axis's event log. The README has the list.
enum class JournalEvent : std::uint8_t {
    service_started,
    service_ends,
    service_failed,
    no_real_time,
    watchdog_failed,
    bad_list,
    configuration,
    face_open,
    face_missing,
    mqtt,
    mqtt_lost,
    master_silent,
    motor_answers,
    motor_lost,
    motor_silent,
    drive,
    stop_unconfirmed,
    stop_given_up,
    stop_confirmed,
    end_unstopped,
    port_gone,
    port_back,
    bus_state,
    missing,
    complete,
    set_point_dropped,
    bad_table,
    table_loaded,
    setting_unused,
    reset,
    run_mark_failed,
    new_operator,
    new_store,
    store_lost,
    store_of_another,
    board_reset,
    client_refused,
};

/// Stable, for programs.
constexpr std::array kJournalEventKeys{
    std::string_view("service_started"),  std::string_view("service_ends"),
    std::string_view("service_failed"),   std::string_view("no_real_time"),
    std::string_view("watchdog_failed"),  std::string_view("bad_list"),
    std::string_view("configuration"),    std::string_view("face_open"),
    std::string_view("face_missing"),     std::string_view("mqtt"),
    std::string_view("mqtt_lost"),        std::string_view("master_silent"),
    std::string_view("motor_answers"),    std::string_view("motor_lost"),
    std::string_view("motor_silent"),     std::string_view("drive"),
    std::string_view("stop_unconfirmed"), std::string_view("stop_given_up"),
    std::string_view("stop_confirmed"),   std::string_view("end_unstopped"),
    std::string_view("port_gone"),        std::string_view("port_back"),
    std::string_view("bus_state"),        std::string_view("missing"),
    std::string_view("complete"),         std::string_view("set_point_dropped"),
    std::string_view("bad_table"),        std::string_view("table_loaded"),
    std::string_view("setting_unused"),   std::string_view("reset"),
    std::string_view("run_mark_failed"),  std::string_view("new_operator"),
    std::string_view("new_store"),        std::string_view("store_lost"),
    std::string_view("store_of_another"), std::string_view("board_reset"),
    std::string_view("client_refused")};
static_assert(kJournalEventKeys.size() == static_cast<std::size_t>(JournalEvent::client_refused) + 1);

/// Every message has one: a JournalEvent, or the key of an entry in the event log.
struct EventKey {
    EventKey(JournalEvent event) : text(kJournalEventKeys[static_cast<std::size_t>(event)]) {}
    explicit EventKey(std::string key) : text(std::move(key)) {}
    std::string text;
};

}  // namespace nplc::boards
