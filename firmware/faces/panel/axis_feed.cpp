#include "axis_feed.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/json_depth.h"
#include "causes/codes.h"
#include "encoding.h"
#include "panel/names.h"
#include "registers/details.h"
#include "registers/family.h"
#include "registers/scale.h"
#include "sequencer/term.h"

namespace nplc::panel {
namespace {

using Json = nlohmann::ordered_json;
namespace own = registers::gateway;
using faces::AxisImage;

constexpr std::size_t kMostEvents = 200;
constexpr std::uint8_t kFirstEvent = 16;

/// Validity of a motor value: more than twice the time after which it is read again.
base::Milliseconds limit_of(faces::MotorItem item) {
    const bool is_often = faces::is_frequent(item) || item == faces::MotorItem::torque;
    return base::Milliseconds(is_often ? 2'000 : 20'000);
}

/// They change continuously: ten updates a second are enough.
constexpr std::array kOften{own::UPTIME,     own::SCANS,  own::SCAN_TIME, own::SCAN_WORST, own::TIMER,
                            own::FORCE_LEFT, own::ORDERS, own::ACCESSES,  own::MESSAGES};

/// Single registers to show; FIRED_* are those of the image's own scan, RESULT belongs to another port.
bool is_shown(const own::Row& row) {
    return row.count == 1 && row.number != own::TABLE_DATA && row.number != own::TABLE_POINTER &&
           row.number != own::RESULT && row.number != own::FIRED_SCAN && row.number != own::FIRED_STEP &&
           row.number != own::FIRED_KEY && row.number != own::IDENTITY &&
           (row.number < own::SET_POINT_POINTER || row.number > own::SET_POINT_WRITE) &&
           (row.number < own::FIRMWARE_BOARD || row.number > own::FIRMWARE_DATA);
}

bool is_slow(std::uint8_t number) {
    return std::find(kOften.begin(), kOften.end(), number) != kOften.end();
}

std::int64_t milliseconds(base::Instant now, base::Instant then) {
    return std::max<std::int64_t>(0, std::chrono::duration_cast<base::Milliseconds>(now - then).count());
}

std::string_view name_of(faces::MotorItem item, const AxisImage& image) {
    const registers::Register* reg = faces::register_of(item, faces::model_of(image));
    return reg == nullptr ? std::string_view() : reg->name;
}

/// Newly read values, and once more those that have become stale since `before`.
Json motor_values(const AxisImage& image, const AxisImage* before, base::Instant now) {
    Json values = Json::object();
    for (std::size_t i = 0; i < faces::kMotorItems; ++i) {
        const auto item = static_cast<faces::MotorItem>(i);
        const faces::MotorValue& value = image.of_motor(item);
        if (!value.is_known) continue;
        const bool is_good = value.quality(now, limit_of(item)) == faces::Quality::good;
        if (before != nullptr && before->of_motor(item).is_known &&
            before->of_motor(item).taken == value.taken) {
            const bool was_good =
                before->of_motor(item).quality(before->taken, limit_of(item)) == faces::Quality::good;
            if (is_good || !was_good) continue;
        }
        const std::string_view name = name_of(item, image);
        if (name.empty()) continue;
        values[std::string(name)] = {value.value, milliseconds(now, value.taken), is_good};
    }
    return values;
}

Json register_info(const registers::Register& reg, registers::Model model) {
    Json info = {{"name", reg.name},
                 {"signed", reg.min < 0},
                 {"long", registers::is_32_bit(reg.format)},
                 {"unit", ""},
                 {"per_unit", 1.0}};
    const auto units = registers::units_of(reg.unit);
    if (units.empty()) return info;
    const std::string_view unit = reg.unit == registers::Unit::counts ? "rev" : units.front();
    if (const auto ratio = registers::raw_per_unit(reg, model, unit)) {
        info["unit"] = unit;
        info["per_unit"] = static_cast<double>(ratio->numerator) / static_cast<double>(ratio->denominator);
    }
    return info;
}

/// The registers that the table writes, and those that its commands use.
Json registers_of(const faces::AxisTable& table, registers::Model model) {
    Json list = Json::object();
    for (std::size_t at = 0; at + sequencer::kTermBytes <= table.bytes.size(); at += sequencer::kTermBytes) {
        const sequencer::TermView term(&table.bytes[at], sequencer::kTermBytes);
        if (sequencer::is_end(term)) break;
        if (!sequencer::is_flex(term)) continue;
        const std::uint8_t number = term[3] & 0x7F;
        if (const auto* reg = registers::find(model, number))
            list[fmt::format("{}", number)] = register_info(*reg, model);
    }
    return list;
}

/// Meanings of ERR_STAT's bits, and the modes of MODE_REG.
Json error_bits(registers::Model model) {
    Json list = Json::array();
    for (const registers::Field& field : registers::fields_of(model, registers::ERR_STAT)) {
        if (field.width == 1)
            list.push_back({{"bit", field.first}, {"name", field.name}, {"text", field.meaning}});
    }
    return list;
}

Json modes_of(registers::Model model) {
    Json modes = Json::object();
    for (const registers::Field& field : registers::fields_of(model, registers::MODE_REG)) {
        for (const registers::NamedValue& value : field.values)
            modes[fmt::format("{}", value.value)] = value.name;
    }
    return modes;
}

/// Null: not known yet.
Json causes_of(const faces::Findings* why) {
    if (why == nullptr) return {};
    Json list = Json::array();
    for (const causes::Finding& one : *why) {
        list.push_back({{"code", one.code},
                        {"number", causes::number_of(one.code)},
                        {"severity", causes::name_of(one.severity)},
                        {"text", one.sentence},
                        {"sources", one.sources},
                        {"remedy", one.remedy}});
    }
    return list;
}

std::string proof_in_hex(const AxisImage& image) {
    std::string text;
    for (unsigned i = 0; i < own::kProofWords; ++i) {
        const std::uint32_t word = image.own[own::PROOF + i];
        for (unsigned byte = 0; byte < 4; ++byte) text += fmt::format("{:02x}", word >> (8 * byte) & 0xFF);
    }
    return text.find_first_not_of('0') == std::string::npos ? std::string() : text;
}

}  // namespace

std::string event_in_words(std::uint8_t code, std::uint16_t detail) {
    std::string name(own::name_of_log_code(code));
    if (code < kFirstEvent) return code == 0 ? "outputs follow the sequence" : "outputs safe: " + name;
    switch (static_cast<own::Event>(code)) {
        case own::Event::upload_failed:
            return fmt::format("{}: {}", name, own::describe(static_cast<own::Result>(detail)));
        case own::Event::motor_fault:
            return fmt::format("{}: {}", name, own::name_of(static_cast<own::DriveFault>(detail)));
        case own::Event::forces_ended:
            return name + (detail == 1 ? ": the client was silent" : ": by a client");
        case own::Event::forced:
            return detail == own::FORCE_OUT ? "outputs forced" : "inputs forced";
        case own::Event::breakpoint:
        case own::Event::held:
            return name + (detail == 1 ? "; cannot go on from there: stop, then run" : "");
        case own::Event::set_points_changed:
        case own::Event::recipe_loaded:
        case own::Event::recipe_saved:
        case own::Event::recipe_deleted:
            return fmt::format("{} by {}", name, own::name_of(static_cast<own::Origin>(detail >> 8)));
        case own::Event::stop_confirmed:
            return fmt::format("{} after {} ms", name, detail);
        case own::Event::line_late:
            return fmt::format("{}, by {} ms: set the latency timer of its USB adapter to 1 ms", name,
                               detail);
        case own::Event::set_points_taken:
            return fmt::format("{}: {}", name, detail);
        case own::Event::upload_aborted:
            return fmt::format("{} after {} bytes", name, detail);
        default:
            return name;
    }
}

std::uint32_t AxisFeed::age(base::Instant now) const {
    if (image_.number == 0) return 0xFFFF;
    return static_cast<std::uint32_t>(milliseconds(now, image_.taken));
}

void AxisFeed::look(base::Instant now) {
    constexpr base::Milliseconds kSeen{2'000};  // what was changed meanwhile is not known after longer
    const std::uint64_t before = image_.number;
    const base::Instant seen = image_.taken;
    std::shared_ptr<const faces::Findings> why;
    model_.want_trend(now);
    image_ = model_.image_with_why(now, &why);
    if (image_.number == 0) return;
    take_why(why);
    if (set_points_.look(image_, model_.set_points())) ++set_points_number_;
    if (image_.taken - seen > kSeen) static_cast<void>(set_points_.take_dropped());
    if (image_.number != before) {
        take_events();
        static_cast<void>(set_points_.take_dropped());
    }
    const auto table = model_.table();
    if (has_program_ && table == table_) return;
    table_ = table;
    take_program();
}

void AxisFeed::take_why(const std::shared_ptr<const faces::Findings>& why) {
    if (why_number_ != 0 && why == why_) return;
    why_ = why;
    std::string text = Json{{"t", "why"}, {"axis", model_.name()}, {"causes", causes_of(why.get())}}.dump();
    if (text == why_text_) return;
    why_text_ = std::move(text);
    ++why_number_;
}

void AxisFeed::take_events() {
    const std::uint32_t count = image_[own::LOG_COUNT];
    if (image_.restarts != restarts_ || count < log_count_) log_count_ = 0;
    restarts_ = image_.restarts;
    if (count - log_count_ > own::kLogEntries) log_count_ = count - own::kLogEntries;
    for (; log_count_ != count; ++log_count_) {
        const std::size_t slot = own::LOG + 2 * (log_count_ % own::kLogEntries);
        const std::uint32_t what = image_.own[slot + 1];
        events_.push_back({++last_event_,
                           image_.own[slot],
                           static_cast<std::uint8_t>(what),
                           static_cast<std::uint8_t>(what >> 8),
                           static_cast<std::uint16_t>(what >> 16),
                           {}});
        events_.back().text = event_text(events_.back());
        if (events_.size() > kMostEvents) events_.pop_front();
    }
}

/// Adds the changed values to the log's text.
std::string AxisFeed::event_text(const LoggedEvent& event) {
    std::string text = event_in_words(event.code, event.detail);
    const auto is = [&](own::Event what) { return event.code == static_cast<std::uint8_t>(what); };
    if (is(own::Event::table_activated)) {
        for (const set_points::Dropped& one : set_points_.take_dropped())
            text += "; " + set_points::text_of(one);
    }
    if (is(own::Event::set_points_dropped) && set_points_.book().is_of(image_))
        return text + ": " + set_points::names_of(set_points_.record(), event.detail);
    if (is(own::Event::recipe_loaded) || is(own::Event::recipe_saved) || is(own::Event::recipe_deleted))
        text += ": " + set_points_.recipe_name(event.detail & 0xFF);
    if (!is(own::Event::recipe_loaded) && !is(own::Event::set_points_changed)) return text;
    const std::string changes = set_points_.changes_at(event.milliseconds);
    return changes.empty() ? text : text + ": " + changes;
}

void AxisFeed::take_program() {
    has_program_ = true;
    ++program_number_;
    const SymbolShelf::Found names = symbols_ == nullptr || table_->bytes.empty()
                                         ? SymbolShelf::Found()
                                         : symbols_->find(index_, table_->crc);
    Json symbols = names.text.empty() || base::is_deeper(names.text, kDeepestJson)
                       ? Json()
                       : Json::parse(names.text, nullptr, false);
    if (symbols.is_discarded() || !symbols.is_object()) symbols = Json();
    const Json message = {{"t", "program"},
                          {"axis", model_.name()},
                          {"file", std::filesystem::path(names.file).filename().string()},
                          {"crc", table_->crc},
                          {"table", to_base64(table_->bytes)},
                          {"proof", proof_in_hex(image_)},
                          {"registers", registers_of(*table_, faces::model_of(image_))},
                          {"symbols", symbols}};
    program_text_ = message.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string AxisFeed::image_text(const AxisImage* before, bool slow_too, base::Instant now) const {
    Json registers = Json::object();
    bool has_quick = before == nullptr;
    for (const own::Row& row : own::map()) {
        if (!is_shown(row)) continue;
        const std::uint32_t value = image_.own[row.number];
        if (before != nullptr && before->own[row.number] == value) continue;
        registers[std::string(row.name)] = value;
        has_quick = has_quick || !is_slow(row.number);
    }
    if (!has_quick && !slow_too) return {};
    Json values = motor_values(image_, before, now);
    if (registers.empty() && values.empty()) return {};
    Json message = {{"t", "image"}, {"axis", model_.name()}, {"age", age(now)}};
    if (before == nullptr) message["full"] = true;
    if (!registers.empty()) message["r"] = std::move(registers);
    if (!values.empty()) message["m"] = std::move(values);
    return message.dump();
}

std::string AxisFeed::events_text(std::uint64_t after) const {
    Json list = Json::array();
    for (const LoggedEvent& event : events_) {
        if (event.number <= after) continue;
        list.push_back({{"n", event.number},
                        {"ms", event.milliseconds},
                        {"code", event.code},
                        {"step", event.step},
                        {"detail", event.detail},
                        {"text", event.text}});
    }
    return Json{{"t", "events"}, {"axis", model_.name()}, {"events", std::move(list)}}.dump();
}

std::string AxisFeed::info_text() const {
    const registers::Model model = faces::model_of(image_);
    const registers::Scale scale = registers::scale_of(model);
    const std::string motor = motor_.empty() ? std::string(registers::name_of(model)) : motor_;
    return Json{{"name", model_.name()},
                {"motor", motor},
                {"counts_per_rev", scale.counts_per_rev},
                {"samples_per_second", scale.samples_per_second},
                {"unit", model_.scaling().unit},
                {"per_revolution", model_.scaling().per_revolution},
                {"error_bits", error_bits(model)},
                {"modes", modes_of(model)}}
        .dump();
}

}  // namespace nplc::panel
