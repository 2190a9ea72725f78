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

/// What a scenario acts upon. A stage without a gateway has its motor only.
class Stage {
  public:
    virtual void set_input(unsigned /*index*/, bool /*level*/) {}
    virtual void toggle_input(unsigned /*index*/) {}
    virtual void cut_line(bool /*cut*/) {}
    virtual void spoil_line(const action::SpoilLine& /*faults*/) {}
    virtual void seed(std::uint64_t /*value*/) {}
    virtual void gateway(action::Gateway /*what*/) {}
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
    std::string expectation;  ///< as the scenario has it
    bool passed = false;
    std::string seen;  ///< what was seen instead, and when
    Time decided{0};
};

/// Rules that set each other off without end at one instant; the message names file and line.
struct EndlessRules : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Plays a Scenario on a Stage and judges its expectations. Must be shown every change of the machine, and
/// the instants that next_due() asks for.
class ScenarioRunner {
  public:
    ScenarioRunner(const Scenario& scenario, const Names& names, Stage& stage);

    /// The next instant at which something is planned, later than the last one shown.
    std::optional<Time> next_due() const;

    /// Judges what is seen, then acts. True if it acted: the stage has changed and wants to be shown again,
    /// at the same time. Throws EndlessRules.
    bool observe(const Snapshot& snapshot);

    /// Does these too, at the next observe().
    void also(Actions actions, Time now) { plan(also_.emplace_back(std::move(actions)), now, 0, false); }

    bool ended() const { return ended_; }
    /// To be called once, with the last snapshot.
    void finish(const Snapshot& snapshot);

    /// An expectation was decided against; called as soon as that is known.
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
        int line;             ///< of the rule that reacted; 0: it goes by the time
        bool by_rule;         ///< else by a time of its own
        std::uint64_t batch;  ///< what was planned together
    };
    struct Watched {
        EventWatch watch;
        std::uint64_t happened = 0;
        bool done = false;
    };
    struct Followed {
        std::optional<bool> wanted;  ///< what the condition says
        std::optional<Time> due;     ///< when the input shows it
    };
    struct Judgement {
        explicit Judgement(const Expectation& wanted) : expectation(&wanted), watch(wanted.event) {}
        const Expectation* expectation;
        EventWatch watch;
        bool decided = false;
        std::uint64_t events = 0;
        std::uint64_t fulfilled = 0;
        std::vector<Time> deadlines;
        std::optional<Time> since{};  ///< the condition has been true
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
    std::deque<Actions> also_;  ///< planned_ points there
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
