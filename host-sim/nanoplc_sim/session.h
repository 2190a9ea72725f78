#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "board_watch.h"
#include "order_audit.h"
#include "program.h"
#include "run_command.h"
#include "sim/scenario_runner.h"
#include "sim/trace_file.h"
#include "sim/world.h"
#include "timeline.h"

namespace nplc::sim {

/// One run: the world, the scenario that plays on it and all its output.
class Session {
  public:
    /// `columns`: width of the terminal, as for Timeline.
    Session(const RunOptions& options, const Program& program, const Scenario& scenario,
            const Palette& palette, std::size_t columns = 0, ports::Storage* storage = nullptr);
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    /// Runs up to `limit` of virtual time or to the end. Throws EndlessRules, FileError.
    void advance(Time limit);
    bool ended() const { return ended_; }
    void stop() { ended_ = true; }
    Time now() const { return world_.now(); }
    std::optional<Time> length() const { return length_; }

    /// For callers that count steps of advance().
    void after_each_step(std::function<void()> look) { after_step_ = std::move(look); }
    /// For faces and the user port, between two calls of advance().
    World& world() { return world_; }

    void press(unsigned input);  ///< toggles it
    /// Carries out actions of the user at the present time.
    void act(Actions actions) {
        runner_.also(std::move(actions), now());
        show();
    }
    const Names& names() const { return program_.names; }
    const Snapshot& seen() const { return last_; }

    /// Judges the expectations, writes the files and prints the summary. True if every expectation passed.
    bool finish();

    std::string keys() const;
    /// Most important items first: a narrow terminal shows the beginning only.
    std::string status_line() const;
    /// Output before every line of the timeline, to erase a status line.
    void clear_line_before_each(const std::string& code) { timeline_.begin_lines_with(code); }
    void heading() const;
    /// Stored settings that do not fit the motor, one line each.
    std::string doubts() const;

  private:
    /// Prints a line, wrapped to the terminal's width.
    void say(const std::string& text, std::size_t indent = 0) const;
    std::string motor_in_words() const;
    void lines_in_words();
    void show();
    void leave_symbols() const;
    void summary();
    void follow_orders();
    void compare_orders();
    void judgements() const;
    void remember(const std::string& remark);
    void last_remarks() const;

    const Program& program_;
    const RunOptions& options_;
    const Scenario& scenario_;
    Palette palette_;
    std::size_t columns_;
    Timeline timeline_;
    World world_;
    BoardWatch watch_{world_, timeline_};
    ScenarioRunner runner_;
    OrderAuditor auditor_;
    std::optional<CsvTrace> csv_;
    std::optional<VcdTrace> vcd_;
    std::optional<OutputFile> junit_;
    std::optional<Time> length_;
    Snapshot last_;
    std::vector<std::string> remarks_;  ///< remarks of the time below
    Time remarked_{0};
    bool ended_ = false;
    std::function<void()> after_step_;
};

}  // namespace nplc::sim
