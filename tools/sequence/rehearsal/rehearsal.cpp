#include "rehearsal/rehearsal.h"

#include <algorithm>

#include "registers/family.h"
#include "rehearsal/names.h"
#include "sim/axis.h"
#include "sim/scenario_runner.h"
#include "sim/world.h"

namespace nplc::rehearsal {
namespace {

using sim::Time;

std::uint64_t microseconds(Time time) {
    return static_cast<std::uint64_t>(std::chrono::duration_cast<std::chrono::microseconds>(time).count());
}

/// Compares the sequence's state, without time and the motor's motion.
bool same_scan(const sim::Snapshot& a, const sim::Snapshot& b) {
    return a.step == b.step && a.outputs == b.outputs && a.inputs == b.inputs && a.counter == b.counter &&
           a.in_position == b.in_position && a.error == b.error && b.orders.empty() &&
           (a.timer == 0) == (b.timer == 0);
}

class Virtual final : public Rehearsal {
  public:
    Virtual(const seqc::Compilation& program, const sim::Names& names, sim::Scenario scenario,
            const sim::WorldOptions& options)
        : names_(names),
          scenario_(std::move(scenario)),
          world_(set_points::with_record(program.table, program.symbols.set_points), options),
          runner_(scenario_, names_, world_) {
        world_.on_log([this](const std::string& text) { remark(text, false); });
        runner_.on_failure([this](const sim::ExpectationResult& outcome, Time) {
            failed_ = true;
            remark("line " + std::to_string(outcome.line) + ": expected: " + outcome.expectation +
                       "; seen: " + outcome.seen,
                   true);
        });
        last_ = world_.take_snapshot();
        observe();
    }

    Stop run(const Until& until) override {
        const Time limit = std::chrono::microseconds(until.limit_us);
        while (world_.now() < limit) {
            if (ended_) return Stop::end;
            const sim::Snapshot before = last_;
            failed_ = false;
            Time stop = limit;
            if (const auto due = runner_.next_due()) stop = std::min(stop, *due);
            if (scenario_.end) stop = std::min(stop, std::max(*scenario_.end, world_.now()));
            world_.step(stop);
            observe();
            if (ended_) return Stop::end;
            if (until.failure && failed_) return Stop::failure;
            const bool entered = last_.step != before.step;
            if (entered && last_.step < 63 && ((until.breakpoints >> last_.step) & 1U) != 0)
                return Stop::breakpoint;
            if (until.error && last_.error && !before.error) return Stop::error;
            if (until.step && entered) return Stop::step;
            if (until.scan && !same_scan(before, last_)) return Stop::scan;
        }
        return Stop::time;
    }

    State state() const override {
        return {
            microseconds(last_.time), last_.step,  last_.timer,   last_.counter, last_.inputs, last_.outputs,
            last_.in_position,        last_.error, last_.link_up, last_.running, last_.p_ist,  last_.v_ist};
    }

    void set_input(unsigned index, bool level) override {
        world_.set_input(index, level);
        observe();
    }

    std::optional<std::int64_t> read_register(std::uint8_t number) const override {
        const registers::Register* reg = registers::find(names_.motor, number);
        if (world_.drive() != nullptr || reg == nullptr) return std::nullopt;
        return world_.mac().read(number);
    }

    bool write_register(std::uint8_t number, std::int64_t value) override {
        const registers::Register* reg = registers::find(names_.motor, number);
        if (world_.drive() != nullptr || reg == nullptr || value < reg->min || value > reg->max) return false;
        world_.mac().write(number, static_cast<std::int32_t>(value));
        return true;
    }

    std::vector<Remark> take_remarks() override { return std::exchange(remarks_, {}); }

    std::string verdict() override {
        runner_.finish(last_);
        const std::size_t failed = runner_.failures();
        const std::size_t all = runner_.outcomes().size();
        if (all == 0) return "";
        return "expectations: " + std::to_string(all - failed) + " passed, " + std::to_string(failed) +
               " failed";
    }

  private:
    void remark(std::string text, bool important) {
        remarks_.push_back({microseconds(world_.now()), std::move(text), important});
    }

    void observe() {
        bool acted = false;
        do {
            const std::uint8_t step = last_.step;
            last_ = world_.take_snapshot();
            for (const sim::SentOrder& order : last_.orders)
                remark(sim::in_words(order, names_.motor), false);
            if (last_.step != step) remark(names_.step(step) + " -> " + names_.step(last_.step), false);
            acted = runner_.observe(last_);
        } while (acted);
        ended_ = ended_ || runner_.ended() || (scenario_.end && world_.now() >= *scenario_.end);
    }

    sim::Names names_;
    sim::Scenario scenario_;
    sim::World world_;
    sim::ScenarioRunner runner_;
    sim::Snapshot last_;
    std::vector<Remark> remarks_;
    bool failed_ = false;
    bool ended_ = false;
};

}  // namespace

Rehearsal::Opened Rehearsal::open(const seqc::Compilation& program, const Options& options) {
    sim::Names names = names_of(program.symbols);
    sim::WorldOptions world;
    const registers::DriveModel* drive = program.symbols.drive;
    if (!options.motor.empty()) {
        drive = registers::find_drive(options.motor);
        const auto model = registers::model_of(options.motor);
        if (drive == nullptr && !model)
            return {nullptr, "there is no motor '" + options.motor + "': write such as MAC140 or MAC34-1"};
        if (model) names.motor = *model;
    }
    names.drive = drive;
    world.motor = names.motor;
    if (drive != nullptr) world.drive = {.model = drive, .can = false, .rate = 0, .seed = 1};
    sim::Scenario scenario;
    if (!options.scenario.empty()) {
        sim::ParsedScenario parsed = sim::parse_scenario(options.scenario, options.scenario_file, names);
        if (!parsed.mistakes.empty()) return {nullptr, sim::in_words(options.scenario_file, parsed.mistakes)};
        scenario = std::move(parsed.scenario);
    }
    world.registers = scenario.registers;
    const sim::AxisReading axis = sim::read_axis({}, scenario, names.motor);
    if (!axis.error.empty()) return {nullptr, axis.error};
    world.load = axis.load;
    return {std::make_unique<Virtual>(program, names, std::move(scenario), world), {}};
}

}  // namespace nplc::rehearsal
