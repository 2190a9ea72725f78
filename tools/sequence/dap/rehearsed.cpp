#include <fmt/format.h>

#include <algorithm>

#include "debuggee.h"
#include "register_values.h"
#include "rehearsal/rehearsal.h"
#include "whole_files/whole_files.h"

namespace nplc::dap {

CompiledProgram compiled(const std::string& file) {
    const whole_files::FileText text = whole_files::read_text(file);
    if (!text.error.empty()) throw Problem(text.error);
    seqc::Sources sources = seqc::read_sources(file, text.text);
    seqc::Compilation compilation = seqc::compile(sources);
    if (compilation.ok) return {std::move(sources), std::move(compilation)};
    for (const seqc::Diagnostic& diagnostic : compilation.diagnostics) {
        if (diagnostic.severity != seqc::Severity::error) continue;
        const seqc::ShownPlace place = seqc::Places(sources).of(diagnostic.span.offset);
        throw Problem(fmt::format("{}:{}:{}: {}", place.file->name, place.at.line, place.at.column,
                                  diagnostic.message));
    }
    throw Problem(file + ": has errors");
}

namespace {

using rehearsal::Rehearsal;
using rehearsal::Stop;

constexpr std::uint64_t kSecond = 1'000'000;
/// Virtual time between two polls for messages.
constexpr std::uint64_t kSlice = 50'000;
constexpr std::uint64_t kRealtimeSlice = 20'000;
constexpr std::uint64_t kLongest = 60 * kSecond;

class Rehearsed final : public Debuggee {
  public:
    Rehearsed(seqc::Symbols symbols, std::unique_ptr<Rehearsal> rehearsal, const Rehearse& options)
        : symbols_(std::move(symbols)),
          rehearsal_(std::move(rehearsal)),
          slice_(options.realtime ? kRealtimeSlice : kSlice) {
        const auto wanted = static_cast<std::uint64_t>(options.seconds * static_cast<double>(kSecond));
        limit_ = wanted > 0                                     ? wanted
                 : options.scenario.empty() || options.realtime ? ~std::uint64_t{0}
                                                                : kLongest * 60;
    }

    const seqc::Symbols& symbols() const override { return symbols_; }

    Look look() override {
        const rehearsal::State state = rehearsal_->state();
        return {fmt::format("{:.3f} s", static_cast<double>(state.time_us) / 1e6),
                state.step,
                state.timer,
                state.counter,
                state.inputs,
                state.outputs,
                state.in_position,
                state.error,
                state.link_up,
                ended_ ? "ended" : "running"};
    }

    void set_breakpoints(std::uint64_t steps) override { until_.breakpoints = steps; }
    void stop_on_error(bool yes) override { until_.error = yes; }
    void stop_on_failure(bool yes) override { until_.failure = yes; }

    void start(Order order) override {
        if (ended_) throw Problem("the rehearsal has ended: start it again");
        until_.step = order == Order::next_step;
        until_.scan = order == Order::next_scan;
    }

    Stopped tick() override {
        const std::uint64_t now = rehearsal_->state().time_us;
        until_.limit_us = std::min(now + slice_, limit_);
        const Stop stop = rehearsal_->run(until_);
        switch (stop) {
            case Stop::breakpoint:
                return {StopReason::breakpoint, "breakpoint"};
            case Stop::step:
            case Stop::scan:
                return {StopReason::step, "step"};
            case Stop::error:
                return {StopReason::exception, "ERROR"};
            case Stop::failure:
                return {StopReason::exception, "an expectation of the scenario failed"};
            case Stop::end:
                return end();
            case Stop::time:
                break;
        }
        return rehearsal_->state().time_us >= limit_ ? end() : Stopped{};
    }

    Stopped pause() override { return {StopReason::pause, "pause"}; }

    void switch_sequence(bool) override {
        throw Problem("a rehearsal runs from its launch to its end: continue, pause, or launch it again");
    }

    std::vector<Variable> registers() override {
        const rehearsal::State state = rehearsal_->state();
        std::vector<Variable> variables = {
            {"P_IST", value_text(symbols_, "P_IST", state.p_ist), "P_IST", false},
            {"V_IST", value_text(symbols_, "V_IST", state.v_ist), "V_IST", false},
        };
        const auto add = [&](const std::string& name, const std::string& reg) {
            const auto* entry = registers::find(symbols_.motor, reg);
            const auto raw = entry == nullptr ? std::nullopt : rehearsal_->read_register(entry->number);
            if (raw) variables.push_back({name, value_text(symbols_, reg, *raw), reg, true});
        };
        for (const char* reg : {"MODE_REG", "P_SOLL", "V_SOLL", "A_SOLL", "T_SOLL", "ERR_STAT", "FLWERR"})
            add(reg, reg);
        for (const seqc::MotorName& name : symbols_.motor_names) add(name.name, name.reg);
        return variables;
    }

    void set_input(unsigned index, bool level) override { rehearsal_->set_input(index, level); }
    void set_output(unsigned, bool) override {
        throw Problem("the sequence writes its outputs: in a rehearsal set inputs and registers");
    }

    std::string set_register(const std::string& name, const std::string& text) override {
        const registers::Register& reg = register_of(symbols_, name);
        const std::int64_t raw = raw_value(symbols_, reg, text);
        if (!rehearsal_->write_register(reg.number, raw))
            throw Problem(fmt::format("{} cannot be set here", reg.name));
        return value_text(symbols_, std::string(reg.name), raw);
    }

    std::vector<std::string> take_remarks() override {
        std::vector<std::string> lines;
        for (const rehearsal::Remark& remark : rehearsal_->take_remarks()) {
            failed_ = failed_ || remark.important;
            lines.push_back(
                fmt::format("{:>9.3f} s  {}", static_cast<double>(remark.time_us) / 1e6, remark.text));
        }
        return lines;
    }

    std::string leave() override { return ended_ ? "" : rehearsal_->verdict(); }
    bool failed() const override { return failed_; }

  private:
    Stopped end() {
        if (ended_) return {StopReason::end, ""};
        ended_ = true;
        std::string verdict = rehearsal_->verdict();
        failed_ = failed_ || (!verdict.empty() && verdict.find(" 0 failed") == std::string::npos);
        return {StopReason::end, std::move(verdict)};
    }

    seqc::Symbols symbols_;
    std::unique_ptr<Rehearsal> rehearsal_;
    rehearsal::Until until_;
    std::uint64_t slice_;
    std::uint64_t limit_ = 0;
    bool ended_ = false;
    bool failed_ = false;
};

}  // namespace

std::unique_ptr<Debuggee> rehearse(const Rehearse& options) {
    const seqc::Compilation program = compiled(options.program).compilation;
    rehearsal::Options how{.scenario = {}, .scenario_file = options.scenario, .motor = options.motor};
    if (!options.scenario.empty()) {
        const whole_files::FileText text = whole_files::read_text(options.scenario);
        if (!text.error.empty()) throw Problem(text.error);
        how.scenario = text.text;
    }
    auto opened = Rehearsal::open(program, how);
    if (!opened.error.empty()) throw Problem(opened.error);
    return std::make_unique<Rehearsed>(program.symbols, std::move(opened.rehearsal), options);
}

}  // namespace nplc::dap
