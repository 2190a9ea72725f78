#include "timeline.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <utility>

namespace nplc::sim {
namespace {

constexpr Time kWhileMoving = std::chrono::milliseconds{250};
constexpr std::int64_t kMoved = 16;  // counts; below it the motion is the regulator's
constexpr std::size_t kWidestSignals = 24;
constexpr std::size_t kWidestStep = 12;  // on a narrow terminal
constexpr std::size_t kLeastEvents = 20;

std::string active(std::uint8_t levels, unsigned count, const auto& name_of) {
    std::string text;
    for (unsigned i = 0; i < count; ++i) {
        if ((levels >> i & 1) != 0) text += (text.empty() ? "" : " ") + name_of(i);
    }
    return text.empty() ? "-" : text;
}

/// Columns wide enough for all named signals, within a limit.
template <std::size_t Count>
std::size_t width_of(const std::array<std::string, Count>& names, std::string_view prefix,
                     std::size_t least) {
    std::size_t width = 0;
    for (unsigned i = 0; i < Count; ++i) {
        if (!names[i].empty() && names[i] != fmt::format("{}{}", prefix, i)) width += names[i].size() + 1;
    }
    return std::clamp(width, least, kWidestSignals);
}

/// Bytes and display width of the character or escape code at the start of `text`.
std::pair<std::size_t, std::size_t> next_of(std::string_view text) {
    if (text.front() == '\033') return {std::min(text.find('m'), text.size() - 1) + 1, 0};
    std::size_t bytes = 1;
    while (bytes < text.size() && (static_cast<unsigned char>(text[bytes]) & 0xC0U) == 0x80U) ++bytes;
    return {bytes, 1};
}

std::size_t room_of(std::string_view text) {
    std::size_t room = 0;
    while (!text.empty()) {
        const auto [bytes, takes] = next_of(text);
        room += takes;
        text.remove_prefix(bytes);
    }
    return room;
}

void mention(std::vector<std::string>& events, bool now, bool before, std::string_view on,
             std::string_view off) {
    if (now != before) events.emplace_back(now ? on : off);
}

}  // namespace

Palette::Palette(bool on) {
    if (!on) return;
    dim = "\033[2m";
    strong = "\033[1m";
    good = "\033[32m";
    bad = "\033[1;31m";
    order = "\033[36m";
    plain = "\033[0m";
}

std::vector<std::string> wrapped(std::string_view text, std::size_t width) {
    std::vector<std::string> lines(1);
    std::size_t used = 0;
    const auto begin_line = [&] {
        lines.emplace_back();
        used = 0;
    };
    while (!text.empty()) {
        std::string_view word = text.substr(0, text.find(' '));
        text.remove_prefix(std::min(word.size() + 1, text.size()));
        const std::size_t room = room_of(word);
        if (used != 0 && used + 1 + room > width) {
            begin_line();
        } else if (used != 0) {
            lines.back() += ' ';
            ++used;
        }
        while (!word.empty()) {
            const auto [bytes, takes] = next_of(word);
            if (used + takes > width) begin_line();
            lines.back() += word.substr(0, bytes);
            used += takes;
            word.remove_prefix(bytes);
        }
    }
    return lines;
}

Timeline::Timeline(const Names& names, const Palette& palette, std::size_t columns)
    : names_(names), palette_(palette) {
    step_width_ = 4;
    for (const auto& [number, name] : names_.steps) step_width_ = std::max(step_width_, name.size());
    inputs_width_ = width_of(names_.inputs, "IN", 9);
    outputs_width_ = width_of(names_.outputs, "OUT", 9);
    constexpr std::size_t kWideNumbers = 60, kNarrowNumbers = 33, kRoomForEvents = 40;
    indent_ = kWideNumbers + step_width_ + inputs_width_ + outputs_width_;
    narrow_ = columns != 0 && columns < indent_ + kRoomForEvents;
    if (narrow_) {
        step_width_ = std::min(step_width_, kWidestStep);
        indent_ = kNarrowNumbers + step_width_;
    }
    events_width_ = columns == 0 ? SIZE_MAX : std::max(columns, indent_ + kLeastEvents) - indent_;
}

std::string Timeline::inputs(const Snapshot& s) const {
    return active(names_.named(s.inputs), kInputs, [&](unsigned i) { return names_.input(i); });
}

std::string Timeline::outputs(const Snapshot& s) const {
    return active(s.outputs, kOutputs, [&](unsigned i) { return names_.output(i); });
}

void Timeline::heading() const {
    if (narrow_) {
        const std::string unit = names_.machine ? names_.machine->name : "rev";
        fmt::print("{}{:>10}  {:<{}}  {:>9}  {:>6}  {}{}\n", palette_.strong, "time", "step", step_width_,
                   "P_IST", "V_IST", "what happens", palette_.plain);
        fmt::print("{}{:>10}  {:<{}}  {:>9}  {:>6}{}\n", palette_.dim, "ms", "", step_width_, unit, "rpm",
                   palette_.plain);
        return;
    }
    fmt::print("{}{:>12}  {:<{}}  {:<{}}  {:<{}}  {:>11} {:>10}  {:>6} {:>8}  {}{}\n", palette_.strong,
               "time", "step", step_width_, "inputs", inputs_width_, "outputs", outputs_width_, "P_IST", "",
               "V_IST", "", "what happens", palette_.plain);
    fmt::print("{}{:>12}  {:<{}}  {:<{}}  {:<{}}  {:>11} {:>10}  {:>6} {:>8}{}\n", palette_.dim, "ms", "",
               step_width_, "", inputs_width_, "", outputs_width_, "counts", "rev", "c/smpl", "rpm",
               palette_.plain);
}

void Timeline::alarm(const std::string& text) {
    remarks_.push_back(fmt::format("{}{}{}", palette_.bad, text, palette_.plain));
}

std::vector<std::string> Timeline::events(const Snapshot& s) const {
    const Snapshot before = last_.value_or(Snapshot{});
    std::vector<std::string> list;
    if (!last_) list.emplace_back("power on");
    if (s.step != before.step) {
        list.push_back(fmt::format("{}{} -> {}{}", palette_.strong, names_.step(before.step),
                                   names_.step(s.step), palette_.plain));
    }
    for (const SentOrder& order : s.orders) {
        list.push_back(fmt::format("{}{}{}", palette_.order, in_words(order, names_.motor), palette_.plain));
    }
    for (unsigned i = 0; i < kInputs; ++i) {
        const bool now = (names_.named(s.inputs) >> i & 1) != 0;
        const bool was = (names_.named(before.inputs) >> i & 1) != 0;
        mention(list, now, was, names_.input(i) + " on", names_.input(i) + " off");
    }
    for (unsigned i = 0; narrow_ && i < kOutputs; ++i) {
        const bool now = (s.outputs >> i & 1) != 0;
        mention(list, now, (before.outputs >> i & 1) != 0, names_.output(i) + " on",
                names_.output(i) + " off");
    }
    mention(list, s.link_up, before.link_up, "link up", "link down");
    mention(list, s.running, before.running, "sequence runs", "sequence stopped");
    mention(list, s.error, before.error, "ERROR", "no ERROR");
    mention(list, s.in_position, before.in_position, "in position", "not in position");
    return list;
}

void Timeline::observe(const Snapshot& s) {
    std::vector<std::string> list = events(s);
    list.insert(list.end(), remarks_.begin(), remarks_.end());
    remarks_.clear();
    const bool outputs_changed = !last_ || last_->outputs != s.outputs;
    const bool moving =
        s.time - printed_.time >= kWhileMoving && std::abs(std::int64_t{s.p_ist} - printed_.p_ist) >= kMoved;
    if (!list.empty() || outputs_changed || moving) print(s, list);
    last_ = s;
    last_->orders.clear();
}

std::string Timeline::step(const Snapshot& s) const {
    const bool stepped = last_ && last_->step != s.step;
    std::string name = names_.step(s.step);
    if (name.size() > step_width_) name = name.substr(0, step_width_ - 1) + '~';
    return fmt::format("{}{:<{}}{}", stepped ? palette_.strong : "", name, step_width_,
                       stepped ? palette_.plain : "");
}

std::string Timeline::wide_columns(const Snapshot& s) const {
    const registers::Scale scale = registers::scale_of(names_.motor);
    const double rpm = s.v_ist * scale.samples_per_second * 60 / scale.counts_per_rev;
    return fmt::format("{:>12}  {}  {:<{}}  {}{:<{}}{}  {:>11} {:>10.3f}  {:>6} {:>8.1f}  ",
                       in_milliseconds(s.time), step(s), inputs(s), inputs_width_,
                       s.outputs != 0 ? palette_.good : "", outputs(s), outputs_width_,
                       s.outputs != 0 ? palette_.plain : "", s.p_ist,
                       static_cast<double>(s.p_ist) / scale.counts_per_rev, s.v_ist, rpm);
}

std::string Timeline::narrow_columns(const Snapshot& s) const {
    const registers::Scale scale = registers::scale_of(names_.motor);
    const double rpm = s.v_ist * scale.samples_per_second * 60 / scale.counts_per_rev;
    const double place =
        s.p_ist * (names_.machine ? names_.machine->per_rev : 1) / static_cast<double>(scale.counts_per_rev);
    return fmt::format("{:>10}  {}  {:>9.3f}  {:>6.0f}  ", in_milliseconds(s.time), step(s), place, rpm);
}

void Timeline::print(const Snapshot& s, const std::vector<std::string>& list) {
    const std::vector<std::string> lines = wrapped(fmt::format("{}", fmt::join(list, ", ")), events_width_);
    fmt::print("{}{}{}\n", line_start_, narrow_ ? narrow_columns(s) : wide_columns(s), lines.front());
    for (std::size_t i = 1; i < lines.size(); ++i)
        fmt::print("{}{:{}}{}\n", line_start_, "", indent_, lines[i]);
    printed_ = s;
}

}  // namespace nplc::sim
