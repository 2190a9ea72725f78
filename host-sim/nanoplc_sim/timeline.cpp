#include "timeline.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

namespace nplc::sim {
namespace {

constexpr Time kWhileMoving = std::chrono::milliseconds{250};
constexpr std::int64_t kMoved = 16;  // counts; below it is the regulator at work
constexpr std::size_t kWidestSignals = 24;

std::string active(std::uint8_t levels, unsigned count, const auto& name_of) {
    std::string text;
    for (unsigned i = 0; i < count; ++i) {
        if ((levels >> i & 1) != 0) text += (text.empty() ? "" : " ") + name_of(i);
    }
    return text.empty() ? "-" : text;
}

/// Columns wide enough for all signals that the program names, within reason.
template <std::size_t Count>
std::size_t width_of(const std::array<std::string, Count>& names, std::string_view prefix,
                     std::size_t least) {
    std::size_t width = 0;
    for (unsigned i = 0; i < Count; ++i) {
        if (!names[i].empty() && names[i] != fmt::format("{}{}", prefix, i)) width += names[i].size() + 1;
    }
    return std::clamp(width, least, kWidestSignals);
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

Timeline::Timeline(const Names& names, const Palette& palette) : names_(names), palette_(palette) {
    step_width_ = 4;
    for (const auto& [number, name] : names_.steps) step_width_ = std::max(step_width_, name.size());
    inputs_width_ = width_of(names_.inputs, "IN", 9);
    outputs_width_ = width_of(names_.outputs, "OUT", 9);
}

std::string Timeline::inputs(const Snapshot& s) const {
    return active(s.inputs, kInputs, [&](unsigned i) { return names_.input(i); });
}

std::string Timeline::outputs(const Snapshot& s) const {
    return active(s.outputs, kOutputs, [&](unsigned i) { return names_.output(i); });
}

void Timeline::heading() const {
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
        const bool now = (s.inputs >> i & 1) != 0;
        mention(list, now, (before.inputs >> i & 1) != 0, names_.input(i) + " on", names_.input(i) + " off");
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

void Timeline::print(const Snapshot& s, const std::vector<std::string>& list) {
    const registers::Scale scale = registers::scale_of(names_.motor);
    const double rpm = s.v_ist * scale.samples_per_second * 60 / scale.counts_per_rev;
    const bool stepped = last_ && last_->step != s.step;
    fmt::print("{}{:>12}  {}{:<{}}{}  {:<{}}  {}{:<{}}{}  {:>11} {:>10.3f}  {:>6} {:>8.1f}  {}\n",
               line_start_, in_milliseconds(s.time), stepped ? palette_.strong : "", names_.step(s.step),
               step_width_, stepped ? palette_.plain : "", inputs(s), inputs_width_,
               s.outputs != 0 ? palette_.good : "", outputs(s), outputs_width_,
               s.outputs != 0 ? palette_.plain : "", s.p_ist,
               static_cast<double>(s.p_ist) / scale.counts_per_rev, s.v_ist, rpm, fmt::join(list, ", "));
    printed_ = s;
}

}  // namespace nplc::sim
