#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "sim/scenario.h"

namespace nplc::sim {

/// The target of a scenario's actions. A stage without a gateway has its motor only.
class Stage {
  public:
    virtual void set_input(unsigned /*index*/, bool /*level*/) {}
    virtual void toggle_input(unsigned /*index*/) {}
    virtual void cut_line(bool /*cut*/) {}
    virtual void spoil_line(const action::SpoilLine& /*faults*/) {}
    virtual void seed(std::uint64_t /*value*/) {}
    virtual void gateway(action::Gateway /*what*/) {}
    virtual void set_breakpoints(const action::Breakpoints& /*where*/) {}
    virtual void force(const action::ForceSignals& /*what*/) {}
    virtual void set_points(const action::SetPoints& /*asked*/) {}
    virtual void log(const std::string& /*text*/) {}
    virtual void fail_motor() = 0;
    virtual void power_motor(bool on) = 0;
    virtual void act(const action::OnMotor& what) = 0;

  protected:
    ~Stage() = default;
};

struct ExpectationResult {
    int line = 0;
    std::string expectation;  ///< as written in the scenario
    bool passed = false;
    std::string seen;  ///< the actual value, and when
    Time decided{0};
};

/// Rules that trigger each other endlessly at one instant; the message names file and line.
struct EndlessRules : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Plays a Scenario on a Stage and judges its expectations. Must be shown every change of the machine, and
/// called at the times of next_due().
class ScenarioRunner {
  public:
    ScenarioRunner(const Scenario& scenario, const Names& names, Stage& stage);

    /// The next planned time after the last snapshot.
    std::optional<Time> next_due() const;

    /// Judges the snapshot, then acts. True if it acted: the stage has changed and must be shown again, at
    /// the same time. Throws EndlessRules.
    bool observe(const Snapshot& snapshot);

    /// Adds these actions at the next observe().
    void also(Actions actions, Time now) { plan(also_.emplace_back(std::move(actions)), now, 0, false); }

    bool ended() const { return ended_; }
    /// To be called once, with the last snapshot.
    void finish(const Snapshot& snapshot);

    /// An expectation has failed; called as soon as that is known.
    void on_failure(std::function<void(const ExpectationResult&, Time)> callback) {
        on_failure_ = std::move(callback);
    }
    const std::vector<ExpectationResult>& outcomes() const {
        return outcomes_;
    }  ///< all of them, after finish()
    std::size_t failures() const;

  private:
    struct Planned {
        const Action* action;
        int line;             ///< line of the rule; 0: triggered by time
        bool by_rule;         ///< else by its own time
        std::uint64_t batch;  ///< number of the group of actions planned together
    };
    struct Watched {
        EventWatch watch;
        std::uint64_t happened = 0;
        bool done = false;
    };
    struct Followed {
        std::optional<bool> wanted;  ///< value of the condition
        std::optional<Time> due;     ///< when the input follows it
    };
    struct Judgement {
        explicit Judgement(const Expectation& wanted) : expectation(&wanted), watch(wanted.event) {}
        const Expectation* expectation;
        EventWatch watch;
        bool decided = false;
        std::uint64_t events = 0;
        std::uint64_t fulfilled = 0;
        std::vector<Time> deadlines;
        std::optional<Time> since{};      ///< the condition has been true
        std::optional<double> nearest{};  ///< of a value that is awaited, what came nearest to it
    };

    void plan(const Actions& actions, Time now, int line, bool by_rule);
    void plan_every(Time now);
    bool follow(const Snapshot& snapshot);
    void cancel(const action::Cancel& what, std::uint64_t batch);
    void guard_against_loops(Time now, int line);
    bool act(Time now);
    void perform(const Planned& planned);
    void judge(Judgement& judgement, const Snapshot& snapshot);
    void judge_at(Judgement& judgement, const Snapshot& snapshot);
    void judge_by(Judgement& judgement, const Snapshot& snapshot);
    std::string nearest_text(const Judgement& judgement) const;
    void judge_always(Judgement& judgement, const Snapshot& snapshot);
    void judge_after_event(Judgement& judgement, const Snapshot& snapshot);
    void judge_during(Judgement& judgement, const Snapshot& snapshot);
    bool event_happens(Judgement& judgement, const Snapshot& snapshot) const;
    bool holds(Judgement& judgement, const Snapshot& snapshot) const;
    void judge_count(Judgement& judgement, const Snapshot& snapshot);
    void judge_at_end(Judgement& judgement, const Snapshot& snapshot);
    void decide(Judgement& judgement, bool passed, Time now, std::string seen = {});
    std::string seen_at(const Condition& condition, const Snapshot& snapshot) const;

    const Scenario& scenario_;
    const Names& names_;
    Stage& stage_;
    std::multimap<Time, Planned> planned_;
    std::deque<Actions> also_;  ///< planned_ has pointers into it
    std::uint64_t batches_ = 0;
    std::vector<Followed> followed_;
    std::vector<Time> every_next_;
    std::vector<Watched> watches_;
    std::vector<Judgement> judgements_;
    std::vector<ExpectationResult> outcomes_;
    std::function<void(const ExpectationResult&, Time)> on_failure_;
    Time last_shown_{-1};
    int rounds_ = 0;
    bool ended_ = false;
};

}  // namespace nplc::sim
