#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "course.h"
#include "cut_storage.h"
#include "line_state.h"
#include "naive_sequencer.h"
#include "order_book.h"
#include "person.h"
#include "program.h"
#include "stored_tables.h"

namespace nplc::soak {

/// Faults that are put in to see that they are found.
enum class Fault : std::uint8_t {
    none,
    order_lost,    ///< the motor forgets an order that comes soon after the line was restored with IN1 on
    order_twice,   ///< the motor executes an order twice after its supply came back
    erase_astray,  ///< the second table that is stored: its slot's erasure hits the other slot
};

/// What holds at every scan, by name.
enum class Invariant : std::uint8_t { orders, scan, outputs, watchdog, polls, store, scenario };
std::string_view name_of(Invariant invariant);

struct Breach {
    Time at{0};
    Invariant invariant = Invariant::orders;
    std::string what;
};

struct Statistics {
    std::uint64_t disturbances = 0;
    std::uint64_t orders = 0;  ///< executed by the motor and found as ordered
    std::uint64_t excused = 0;
    std::uint64_t scans = 0;  ///< not skipped
    std::uint64_t starts = 0;
    std::uint64_t torn = 0;    ///< operations of the storage
    std::uint64_t stored = 0;  ///< tables
    std::uint64_t answers = 0;
    std::uint64_t early_heap = 0;  ///< most bytes in use, looked at every ten minutes, in the first half
    std::uint64_t late_heap = 0;   ///< of the second half
};

/// A course, or a scenario, on the simulated board, watched.
class SoakRun final : private sim::Stage, private gateway::Observer {
  public:
    SoakRun(const sim::Program& program, std::uint64_t seed, Fault fault);

    std::optional<Breach> play(const Course& course, Time end);
    std::optional<Breach> play(const sim::Scenario& scenario);

    Statistics statistics() const;

  private:
    static constexpr std::uint8_t kSafeOutputs = 0;

    sim::WorldOptions options(std::uint64_t seed);
    void act(const Disturbance& what);
    void go_on(Time until);
    void after_step();
    void take_executed();
    void excuse_alike();
    void check_store(const std::string& wrong);
    void check_outputs();
    void note_heap();
    void cut_power();
    void upload(unsigned which);
    std::vector<std::uint8_t> table(unsigned which) const;
    void breach(Invariant invariant, const std::string& what);

    void set_input(unsigned index, bool level) override;
    void cut_line(bool cut) override;
    void spoil_line(const sim::action::SpoilLine& faults) override;
    void seed(std::uint64_t value) override;
    void gateway(sim::action::Gateway what) override;
    void fail_motor() override { world_.fail_motor(); }
    void power_motor(bool on) override;
    void act(const sim::action::OnMotor& what) override { static_cast<sim::Stage&>(world_).act(what); }

    void ordered(base::Instant now, const sequencer::MotorOrder& order) override;
    void scanned(base::Instant now, const sequencer::State& before, sequencer::InputImage image,
                 const sequencer::State& after) override;

    const sim::Program& program_;
    Fault fault_;
    property::Dice dice_;
    CutStorage storage_;
    naive::Sequencer naive_;
    std::vector<sequencer::MotorOrder> scan_orders_;
    sim::World world_;
    OrderBook orders_;
    Person person_;
    LineState line_;
    StoredTables stored_{world_};

    bool was_ordered_ = false;
    Time armed_until_{0};  ///< the fault, for the next order that is executed
    bool scanned_since_start_ = false;
    std::uint64_t starts_ = 0;
    Time next_heap_{std::chrono::minutes{10}};
    Time half_{0};
    Statistics counted_;
    std::optional<Breach> breach_;
};

}  // namespace nplc::soak
