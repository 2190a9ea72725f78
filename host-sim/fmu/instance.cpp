#include "instance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

namespace nplc::sim::fmu {
namespace {

constexpr double kLongest = 1e9;          // s, longest simulation
constexpr double kNanoseconds = 1e9;      // in a second
constexpr double kSlack = 1e-6;           // s, tolerance for the sum of an importer's steps
constexpr double kRelativeSlack = 1e-12;  // and relative to its time

std::string_view in_words(Kind kind) {
    switch (kind) {
        case Kind::real:
            return "Float64 (Real)";
        case Kind::integer:
            return "Int32 (Integer)";
        case Kind::bits:
            return "UInt32 (Integer)";
        case Kind::truth:
            return "Boolean";
    }
    return "";
}

}  // namespace

/// The complete state that get and set state handle.
struct Instance::Simulation {
    std::unique_ptr<Machine> machine;
    Values values;   // visible to the importer
    Values applied;  // inputs as applied to the machine
    Mode mode = Mode::instantiated;
    double start = 0;
    std::optional<double> stop;
    double time = 0;
    Time now{0};  // since the start
};

struct Instance::State {
    Simulation* simulation;
    Arena::Image image;
};

Instance* Instance::make(const char* token, const std::string& resources, Report report) {
    SetupReading reading = read_setup(resources);
    if (!reading.problem.empty()) {
        report(reading.problem);
        return nullptr;
    }
    const std::string wanted = token_of(reading.setup);
    if (token == nullptr || token != wanted) {
        report(
            fmt::format("the instantiation token (GUID) is {} and this machine's is {}: "
                        "modelDescription.xml and resources must be those of one FMU",
                        token == nullptr ? "missing" : token, wanted));
        return nullptr;
    }
    auto* instance = new Instance(std::move(reading.setup), std::move(report));
    try {
        instance->build();
    } catch (const std::exception& error) {
        instance->refuse(error.what());
        delete instance;
        return nullptr;
    }
    return instance;
}

Instance::Instance(Setup setup, Report report)
    : setup_(std::move(setup)),
      report_(std::move(report)),
      variables_(variables_of(setup_)),
      by_reference_(kReferences, nullptr) {
    for (const Variable& variable : variables_)
        by_reference_[static_cast<std::size_t>(variable.id)] = &variable;
}

Instance::~Instance() {
    tear_down();
    for (State* state : states_) delete state;
}

void Instance::build() {
    const AllocateIn here(arena_);
    auto made = std::make_unique<Simulation>();
    made->machine = make_machine(setup_);
    made->values = made->applied = start_values(variables_);
    made->machine->read(made->values);
    simulation_ = made.release();
}

void Instance::tear_down() {
    const AllocateIn here(arena_);
    delete std::exchange(simulation_, nullptr);
}

bool Instance::needs(Mode mode, std::string_view what) const {
    if (simulation_->mode == mode) return true;
    constexpr std::string_view kModes[] = {"just instantiated", "in initialization mode", "in step mode",
                                           "terminated"};
    return refuse(fmt::format("{}: only when the instance is {}, and it is {}", what,
                              kModes[static_cast<std::size_t>(mode)],
                              kModes[static_cast<std::size_t>(simulation_->mode)]));
}

bool Instance::set_experiment(double start, std::optional<double> stop) {
    if (!needs(Mode::instantiated, "setting up the experiment")) return false;
    if (!std::isfinite(start) || std::abs(start) > kLongest)
        return refuse(fmt::format("a start time of {} s; give one within {:g} s", start, kLongest));
    if (stop && !(*stop >= start))
        return refuse(fmt::format("a stop time of {} s is before the start", *stop));
    simulation_->start = simulation_->time = start;
    simulation_->stop = stop;
    return true;
}

bool Instance::enter_initialization() {
    if (!needs(Mode::instantiated, "entering initialization mode")) return false;
    simulation_->mode = Mode::initialization;
    return true;
}

bool Instance::exit_initialization() {
    if (!needs(Mode::initialization, "leaving initialization mode")) return false;
    const AllocateIn here(arena_);
    Simulation& simulation = *simulation_;
    simulation.machine->take_parameters(simulation.values);
    apply();
    simulation.machine->read(simulation.values);
    simulation.mode = Mode::stepping;
    return true;
}

/// Speed, acceleration and torque before the position, and the mode last.
void Instance::apply() {
    Simulation& simulation = *simulation_;
    const auto apply_one = [&simulation](Id id) {
        if (simulation.values[id] == simulation.applied[id]) return;
        simulation.applied[id] = simulation.values[id];
        simulation.machine->set(id, simulation.values[id]);
    };
    for (const Variable& variable : variables_) {
        if (variable.causality == Causality::input && variable.id != Id::p_soll &&
            variable.id != Id::mode_reg)
            apply_one(variable.id);
    }
    if (setup_.table) return;
    apply_one(Id::p_soll);
    apply_one(Id::mode_reg);
}

bool Instance::step(double now, double size) {
    if (!needs(Mode::stepping, "a step")) return false;
    Simulation& simulation = *simulation_;
    if (!std::isfinite(now) || !std::isfinite(size))
        return refuse(fmt::format("a step from {} s of {} s: both must be numbers", now, size));
    if (size <= 0) return refuse(fmt::format("a step of {} s: it must be longer than 0", size));
    if (std::abs(now - simulation.time) > kSlack + kRelativeSlack * std::abs(now))
        return refuse(fmt::format("a step from {} s: the last one ended at {} s", now, simulation.time));
    const double end = now + size;
    if (simulation.stop && end > *simulation.stop + kSlack)
        return refuse(fmt::format("a step to {} s: the stop time is {} s", end, *simulation.stop));
    if (end - simulation.start > kLongest)
        return refuse(fmt::format("a step to {} s: a simulation lasts {:g} s at most", end, kLongest));
    const AllocateIn here(arena_);
    apply();
    simulation.now = std::max(simulation.now, Time(std::llround((end - simulation.start) * kNanoseconds)));
    simulation.machine->advance(simulation.now);
    simulation.machine->read(simulation.values);
    simulation.time = end;
    return true;
}

bool Instance::terminate() {
    if (!needs(Mode::stepping, "terminating")) return false;
    simulation_->mode = Mode::terminated;
    return true;
}

bool Instance::reset() {
    tear_down();
    build();
    return true;
}

double Instance::time() const {
    return simulation_->time;
}

const Variable* Instance::find(std::uint32_t reference, Kind kind) const {
    const Variable* variable = reference < by_reference_.size() ? by_reference_[reference] : nullptr;
    if (variable == nullptr) {
        refuse(fmt::format("value reference {}: there is no such variable", reference));
        return nullptr;
    }
    if (variable->kind == kind) return variable;
    refuse(fmt::format("{} (value reference {}) is a {}, not a {}", variable->name, reference,
                       in_words(variable->kind), in_words(kind)));
    return nullptr;
}

bool Instance::get(const std::uint32_t* references, std::size_t count, Kind kind, double* values) {
    for (std::size_t i = 0; i < count; ++i) {
        const Variable* variable = find(references[i], kind);
        if (variable == nullptr) return false;
        values[i] = variable->id == Id::time ? simulation_->time : simulation_->values[variable->id];
    }
    return true;
}

std::string Instance::why_not_set(const Variable& variable, double value) const {
    const Mode mode = simulation_->mode;
    if (mode == Mode::terminated) return "the instance is terminated";
    if (variable.causality == Causality::output || variable.causality == Causality::independent)
        return "it is no input and no parameter";
    if (variable.causality == Causality::parameter && mode == Mode::stepping)
        return "it is a fixed parameter, set before or in initialization mode";
    if (!std::isfinite(value)) return fmt::format("{} is no number", value);
    if ((variable.min && value < *variable.min) || (variable.max && value > *variable.max))
        return fmt::format("{} is beyond {:.10g} to {:.10g}", value, *variable.min, *variable.max);
    return {};
}

bool Instance::set(const std::uint32_t* references, std::size_t count, Kind kind, const double* values) {
    for (std::size_t i = 0; i < count; ++i) {
        const Variable* variable = find(references[i], kind);
        if (variable == nullptr) return false;
        if (const std::string why = why_not_set(*variable, values[i]); !why.empty())
            return refuse(fmt::format("{} cannot be set: {}", variable->name, why));
    }
    for (std::size_t i = 0; i < count; ++i) simulation_->values[static_cast<Id>(references[i])] = values[i];
    return true;
}

bool Instance::save_into(void** place) {
    if (place == nullptr) return refuse("there is no place for the state");
    if (!forget_at(place)) return false;
    auto* state = new State{simulation_, arena_.image()};
    states_.push_back(state);
    *place = state;
    return true;
}

bool Instance::restore(const State* state) {
    if (std::find(states_.begin(), states_.end(), state) == states_.end())
        return refuse("this state is not one of this instance");
    arena_.restore(state->image);
    simulation_ = state->simulation;
    return true;
}

bool Instance::forget(void* state) {
    const auto found = std::find(states_.begin(), states_.end(), state);
    if (found == states_.end()) return refuse("this state is not one of this instance");
    delete *found;
    states_.erase(found);
    return true;
}

bool Instance::forget_at(void** place) {
    if (place == nullptr || *place == nullptr) return true;
    if (!forget(*place)) return false;
    *place = nullptr;
    return true;
}

bool Instance::is_bits(std::uint32_t reference) const {
    const Variable* variable = reference < by_reference_.size() ? by_reference_[reference] : nullptr;
    return variable != nullptr && variable->kind == Kind::bits;
}

bool Instance::refuse(const std::string& why) const {
    if (reports_) report_(why);
    return false;
}

bool Instance::refuse_unsupported(std::string_view function) const {
    return refuse(fmt::format("{}: this FMU does not offer it", function));
}

bool Instance::set_logging(bool on, std::size_t count, const char* const* categories) {
    for (std::size_t i = 0; i < count; ++i) {
        const std::string_view category = categories[i] == nullptr ? "" : categories[i];
        if (category != kErrors)
            return refuse(fmt::format("log category \"{}\": there is none but {}", category, kErrors));
    }
    reports_ = on;
    return true;
}

}  // namespace nplc::sim::fmu
