#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "arena.h"
#include "sim/fmu/machine.h"

namespace nplc::sim::fmu {

/// The only category of messages.
inline constexpr std::string_view kErrors = "logStatusError";

/// Reports to the importer what was refused and why.
using Report = std::function<void(const std::string& message)>;

/// An instance of the FMU, independent of the FMI version. A refused call is reported, returns false and
/// changes nothing. Instances are independent of each other; each may be used by one thread at a time.
class Instance {
  public:
    /// Null, with a report: wrong token or resources, or an impossible machine.
    static Instance* make(const char* token, const std::string& resources, Report report);
    Instance(const Instance&) = delete;
    Instance& operator=(const Instance&) = delete;
    ~Instance();

    /// Start and stop time, before the initialization mode; without it the start is 0.
    bool set_experiment(double start, std::optional<double> stop);
    bool enter_initialization();
    bool exit_initialization();
    bool step(double now, double size);
    bool terminate();
    /// As newly made.
    bool reset();

    /// The last communication point.
    double time() const;

    /// `values`: one per reference, of variables of this kind.
    bool get(const std::uint32_t* references, std::size_t count, Kind kind, double* values);
    bool set(const std::uint32_t* references, std::size_t count, Kind kind, const double* values);

    struct State;
    /// `*place` is null, or a state that is replaced.
    bool save_into(void** place);
    bool restore(const State* state);
    bool forget_at(void** place);

    /// Whether the variable exists and is a bit register.
    bool is_bits(std::uint32_t reference) const;

    bool refuse(const std::string& why) const;
    bool refuse_unsupported(std::string_view function) const;
    /// Without categories: all.
    bool set_logging(bool on, std::size_t count, const char* const* categories);

  private:
    enum class Mode : std::uint8_t { instantiated, initialization, stepping, terminated };
    struct Simulation;

    Instance(Setup setup, Report report);
    void build();
    void tear_down();
    const Variable* find(std::uint32_t reference, Kind kind) const;
    std::string why_not_set(const Variable& variable, double value) const;
    bool needs(Mode mode, std::string_view what) const;
    void apply();
    bool forget(void* state);

    Setup setup_;
    Report report_;
    bool reports_ = true;
    std::vector<Variable> variables_;
    std::vector<const Variable*> by_reference_;
    std::vector<State*> states_;
    Arena arena_;
    Simulation* simulation_ = nullptr;  // allocated in arena_, with all its parts
};

}  // namespace nplc::sim::fmu
