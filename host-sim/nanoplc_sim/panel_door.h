#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "panel/panel.h"
#include "program.h"
#include "session.h"
#include "sim_faces.h"

namespace nplc::sim {

/// Virtual time that follows the wall clock.
class Pace {
  public:
    using Clock = std::chrono::steady_clock;
    explicit Pace(Clock::time_point now) : last_(now) {}
    /// `speed`: virtual seconds per wall-clock second since the last call; 0 while time is stopped.
    Time virtual_time(Clock::time_point now, double speed) {
        passed_ += std::chrono::duration<double, std::nano>(now - last_) * speed;
        last_ = now;
        return std::chrono::duration_cast<Time>(passed_);
    }

  private:
    Clock::time_point last_;
    std::chrono::duration<double, std::nano> passed_{0};
};

/// The browser panel of a run in real time; inactive without --panel. Requests arrive on the panel's thread,
/// are queued, and are carried out by serve() on the run's thread.
class PanelDoor final : public panel::Simulation, public panel::SymbolShelf {
  public:
    /// Throws InputError if it cannot be opened at `where`, ADDRESS:PORT.
    PanelDoor(const std::optional<std::string>& where, const Program& program, faces::AxisModel& axis);
    PanelDoor(const PanelDoor&) = delete;
    PanelDoor& operator=(const PanelDoor&) = delete;

    bool is_open() const { return panel_ != nullptr; }
    /// Starts to serve browsers, and prints address and token.
    void open();
    /// Carries out the requests since the last call.
    void serve(Session& session);
    /// A face's write to the gateway, between two steps of the world: for the record.
    void ordered(const faces::Command& command);
    /// After every step of the world: records forces and breakpoints.
    void look(Session& session);
    double speed() const;

    State state() const override;
    std::string act(std::string_view action) override;
    void note(std::string_view action) override;
    void pause(bool on) override;
    void set_speed(double speed) override;
    std::string record() const override;
    void clear_record() override;

    Found find(std::size_t axis, std::uint32_t crc) override;
    std::string keep(std::size_t axis, std::uint32_t crc, std::string_view text) override;

  private:
    struct Wanted {
        std::string text;
        Actions actions;
        bool blocks = false;  ///< the shaft, at its present position
    };
    /// What the operator has set in the gateway.
    struct Set {
        registers::gateway::Force inputs;
        registers::gateway::Force outputs;
        std::uint64_t breakpoints = 0;
        bool operator==(const Set& other) const {
            return inputs.in_register() == other.inputs.in_register() &&
                   outputs.in_register() == other.outputs.in_register() && breakpoints == other.breakpoints;
        }
    };
    void perform(Session& session, Wanted wanted);
    /// These need mutex_ locked.
    void record_force(double now, bool is_input, const registers::gateway::Force& before,
                      const registers::gateway::Force& after);
    std::string step_name(std::uint8_t step) const;
    void take_names(std::uint32_t crc, std::string_view symbols);
    /// Needs mutex_ locked.
    void add_to_record(double milliseconds, std::string_view text);

    const Program& program_;
    const faces::AxisModel& axis_;
    std::vector<std::string> ordered_;  ///< commands since the last serve(), as actions; of the run's thread
    Set set_;                           ///< as recorded; of the run's thread
    mutable std::mutex mutex_;
    std::vector<Wanted> wanted_;
    Names names_;  ///< of the active table
    std::optional<std::uint32_t> active_;
    State state_;
    std::string record_;
    std::map<std::uint32_t, std::string> symbols_;  ///< from uploads; used by the panel's thread only
    std::unique_ptr<panel::Panel> panel_;           ///< last member: its thread uses all of the above
};

}  // namespace nplc::sim
