#include "sim/trace_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <bitset>
#include <cctype>

#include "sim/snapshot.h"

namespace nplc::sim {
namespace {

bool same_row(const Snapshot& a, const Snapshot& b) {
    return a.step == b.step && a.timer == b.timer && a.counter == b.counter && a.inputs == b.inputs &&
           a.outputs == b.outputs && a.in_position == b.in_position && a.error == b.error &&
           a.p_ist == b.p_ist && a.v_ist == b.v_ist && a.orders == b.orders;
}

constexpr Time kCommandShown = std::chrono::milliseconds{1};

/// Identifier codes, one printable character each.
constexpr char kStep = '!', kStepName = '"', kTimer = '#', kCounter = '$', kInPos = '%', kError = '&',
               kLink = '\'', kCommand = '(', kPosition = ')', kSpeed = '*', kRpm = '+';
constexpr char kFirstInput = 'A', kFirstOutput = 'a';

std::string id(char c) {
    return std::string(1, c);
}

std::string code(char first, unsigned index) {
    return id(static_cast<char>(first + static_cast<char>(index)));
}

template <std::size_t Bits>
std::string vector(std::uint32_t value, char name) {
    return fmt::format("b{} {}", std::bitset<Bits>(value).to_string(), name);
}

std::string scalar(bool value, const std::string& name) {
    return (value ? "1" : "0") + name;
}

/// Strings of a dump must not contain blanks.
std::string string_value(std::string text, char name) {
    std::replace_if(
        text.begin(), text.end(), [](unsigned char c) { return c <= ' ' || c > '~'; }, '_');
    return fmt::format("s{} {}", text, name);
}

std::string commands(const std::vector<SentOrder>& orders, registers::Model motor) {
    std::string text;
    for (const SentOrder& order : orders) {
        if (!text.empty()) text += ',';
        for (const char c : in_words(order, motor)) {
            if (c != ' ') text += c;
        }
    }
    return text;
}

double rpm_of(std::int32_t v_ist, registers::Model motor) {
    const registers::Scale scale = registers::scale_of(motor);
    return v_ist * scale.samples_per_second * 60 / scale.counts_per_rev;
}

/// A signal may have the same name as another item of the dump.
std::string signal_name(const std::string& name, const std::string& number) {
    return name == "step" || name == "step_name" || name == "timer" || name == "counter" || name == "command"
               ? name + "_" + number
               : name;
}

}  // namespace

CsvTrace::CsvTrace(const std::string& path) : file_(path) {
    file_.write("time_ms,step,timer,counter,inputs,outputs,inpos,error,command,p_ist,v_ist\n");
}

Time CsvTrace::next_due() const {
    return last_ ? last_->time + kLongestGap : Time{0};
}

void CsvTrace::observe(const Snapshot& s) {
    const bool changed = !last_ || !same_row(s, *last_);
    if (!changed && s.time < next_due()) return;
    if (!changed || s.time > last_->time) write_held();
    if (changed) {
        write_row(s);
    } else {
        last_ = s;
    }
    holds_ = !changed;
}

void CsvTrace::write_held() {
    if (!holds_) return;
    holds_ = false;
    write_row(Snapshot{*last_});
}

void CsvTrace::finish(const Snapshot& last) {
    write_held();
    if (!last_ || last.time > last_->time) write_row(last);
    file_.commit();
}

void CsvTrace::write_row(const Snapshot& s) {
    file_.write(fmt::format("{},{},{},{},{},{},{:d},{:d},{},{},{}\n", in_milliseconds(s.time), s.step,
                            s.timer, s.counter, s.inputs, s.outputs, s.in_position, s.error,
                            in_numbers(s.orders), s.p_ist, s.v_ist));
    last_ = s;
    last_->orders.clear();
}

VcdTrace::VcdTrace(const std::string& path, const Names& names, const std::string& comment)
    : file_(path), names_(names) {
    header(comment);
}

void VcdTrace::header(const std::string& comment) {
    std::string text = "$version nanoplc-sim $end\n";
    if (!comment.empty()) text += fmt::format("$comment {} $end\n", comment);
    text += "$timescale 1 us $end\n$scope module nanoplc $end\n";
    const auto declare = [&](std::string_view type, int bits, const std::string& code_text,
                             std::string_view name) {
        text += fmt::format("$var {} {} {} {} $end\n", type, bits, code_text, name);
    };
    declare("wire", 6, id(kStep), "step");
    declare("string", 1, id(kStepName), "step_name");
    declare("wire", 16, id(kTimer), "timer");
    declare("wire", 16, id(kCounter), "counter");
    for (unsigned i = 0; i < kInputs; ++i)
        declare("wire", 1, code(kFirstInput, i), signal_name(names_.input(i), fmt::format("IN{}", i)));
    for (unsigned i = 0; i < kOutputs; ++i)
        declare("wire", 1, code(kFirstOutput, i), signal_name(names_.output(i), fmt::format("OUT{}", i)));
    declare("string", 1, id(kCommand), "command");
    text += "$upscope $end\n$scope module motor $end\n";
    declare("wire", 1, id(kInPos), "in_position");
    declare("wire", 1, id(kError), "error");
    declare("wire", 1, id(kLink), "link_up");
    declare("integer", 32, id(kPosition), "p_ist");
    declare("integer", 32, id(kSpeed), "v_ist");
    declare("real", 64, id(kRpm), "speed_rpm");
    text += "$upscope $end\n$enddefinitions $end\n";
    file_.write(text);
}

void VcdTrace::at(Time time) {
    now_us_ = time.count() / 1000;
}

void VcdTrace::put(const std::string& name, const std::string& value) {
    std::string& known = values_[name];
    if (known == value) return;
    known = value;
    if (written_us_ != now_us_) file_.write(fmt::format("#{}\n", now_us_));
    written_us_ = now_us_;
    file_.write(value + "\n");
}

void VcdTrace::fall_back(Time time) {
    if (!command_until_ || time < *command_until_) return;
    at(*command_until_);
    put(id(kCommand), string_value("-", kCommand));
    command_until_.reset();
}

void VcdTrace::observe(const Snapshot& s) {
    fall_back(s.time);
    at(s.time);
    put(id(kStep), vector<6>(s.step, kStep));
    put(id(kStepName), string_value(names_.step(s.step), kStepName));
    put(id(kTimer), vector<16>(s.timer, kTimer));
    put(id(kCounter), vector<16>(s.counter, kCounter));
    for (unsigned i = 0; i < kInputs; ++i) {
        put(code(kFirstInput, i), scalar((names_.named(s.inputs) >> i & 1) != 0, code(kFirstInput, i)));
    }
    for (unsigned i = 0; i < kOutputs; ++i) {
        put(code(kFirstOutput, i), scalar((s.outputs >> i & 1) != 0, code(kFirstOutput, i)));
    }
    put(id(kInPos), scalar(s.in_position, id(kInPos)));
    put(id(kError), scalar(s.error, id(kError)));
    put(id(kLink), scalar(s.link_up, id(kLink)));
    put(id(kPosition), vector<32>(static_cast<std::uint32_t>(s.p_ist), kPosition));
    put(id(kSpeed), vector<32>(static_cast<std::uint32_t>(s.v_ist), kSpeed));
    put(id(kRpm), fmt::format("r{:.6g} {}", rpm_of(s.v_ist, names_.motor), kRpm));
    if (s.orders.empty() && values_.contains(id(kCommand))) return;
    put(id(kCommand), string_value(s.orders.empty() ? "-" : commands(s.orders, names_.motor), kCommand));
    if (!s.orders.empty()) command_until_ = s.time + kCommandShown;
}

void VcdTrace::finish(Time end) {
    fall_back(end);
    if (written_us_ != end.count() / 1000) file_.write(fmt::format("#{}\n", end.count() / 1000));
    file_.commit();
}

}  // namespace nplc::sim
