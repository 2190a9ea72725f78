#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>

#include "analysis/story.h"
#include "findings.h"

namespace nplc::verify {
namespace {

using Node = Explorer::Node;

bool shows_error(const Place& place) {
    return place.motor == Place::Motor::error || place.motor == Place::Motor::lost;
}

class Errors : public std::enable_shared_from_this<Errors> {
  public:
    explicit Errors(const Subject& subject)
        : explorer_(subject.explorer),
          machine_(explorer_.machine()),
          names_(subject.names),
          courses_(subject.courses) {
        find_fault_steps();
        find_ways_to_reset();
    }

    std::vector<Finding> find() {
        spread_to_copies();
        std::array<bool, 63> told{};
        for (Node node = 0; node < explorer_.size(); ++node) {
            const Place place = explorer_.place(node);
            if (!is_fault_step_[place.step] || !shows_error(place) || resets_[node] || told[place.step])
                continue;
            auto course = courses_.to(node);
            if (!course) continue;
            told[place.step] = true;
            tell_stuck(node, place, std::move(*course));
        }
        find_outputs_left_on();
        return std::move(findings_);
    }

  private:
    /// Steps that ERROR leads to: the same images without it do not.
    void find_fault_steps() {
        for (std::uint8_t step = 0; step <= sequencer::kLastStep; ++step) {
            for (unsigned zeros = 0; zeros < 4; ++zeros) {
                for (unsigned image = sequencer::kError; image < 256; ++image)
                    note_fault_step(step, zeros, static_cast<std::uint8_t>(image));
            }
        }
    }

    void note_fault_step(std::uint8_t step, unsigned zeros, std::uint8_t image) {
        const auto next_with = [&](std::uint8_t seen) {
            return machine_.group_with(step, (zeros & 1U) != 0, (zeros & 2U) != 0, seen).outcome.next;
        };
        const std::uint8_t next = next_with(image);
        if (next == step || next == 0) return;
        if (next_with(static_cast<std::uint8_t>(image & ~sequencer::kError)) != next)
            is_fault_step_[next] = true;
    }

    /// A property of a step also applies to its copies, since ERROR may lead to any of them.
    void spread_to_copies() {
        const auto copy_of = [&](std::uint8_t step) { return names_.copy_of[step].value_or(step); };
        std::array<bool, 64> whole{};
        for (std::uint8_t step = 0; step < names_.copy_of.size(); ++step)
            whole[copy_of(step)] = whole[copy_of(step)] || is_fault_step_[step];
        for (std::uint8_t step = 0; step < names_.copy_of.size(); ++step)
            is_fault_step_[step] = whole[copy_of(step)];
    }

    /// Places from which, while ERROR lasts, some course sends RESET_ERROR.
    void find_ways_to_reset() {
        resets_.assign(explorer_.size(), false);
        std::vector<Node> open;
        for (auto node = static_cast<Node>(explorer_.size()); node-- > 0;) {
            if (shows_error(explorer_.place(node))) open.push_back(node);
        }
        for (bool changed = true; changed;) {
            changed = std::erase_if(open, [&](Node node) {
                          const auto edges = explorer_.edges_from(node);
                          resets_[node] =
                              std::any_of(edges.begin(), edges.end(), [&](const Explorer::Edge& edge) {
                                  return explorer_.group_of(edge).resets_error || resets_[edge.to];
                              });
                          return resets_[node];
                      }) != 0;
        }
    }

    bool is_stuck(Node node, std::uint8_t step) const {
        const Place& place = explorer_.place(node);
        return place.step == step && shows_error(place) && !resets_[node];
    }

    /// From the node, ERROR lasting, some course comes to another step.
    bool leaves_step(Node node) const {
        std::vector<Node> open = {node};
        std::vector<bool> seen(explorer_.size());
        seen[node] = true;
        while (!open.empty()) {
            const Node at = open.back();
            open.pop_back();
            if (explorer_.place(at).step != explorer_.place(node).step) return true;
            for (const Explorer::Edge& edge : explorer_.edges_from(at)) {
                if (seen[edge.to] || !shows_error(explorer_.place(edge.to))) continue;
                seen[edge.to] = true;
                open.push_back(edge.to);
            }
        }
        return false;
    }

    void tell_stuck(Node node, const Place& place, Scans course) {
        const bool leaves = leaves_step(node);
        const std::string step = step_name(names_, place.step);
        const char* when = place.motor == Place::Motor::lost ? "after a lost link (ERROR without INPOS)"
                                                             : "while ERROR lasts";
        findings_.push_back(
            {leaves ? "V005" : "V004", place.step,
             leaves
                 ? fmt::format("{} no way from step {} sends RESET_ERROR: it always comes back", when, step)
                 : fmt::format("{} nothing leaves step {}, and it sends no RESET_ERROR", when, step),
             std::move(course),
             [this, keep = shared_from_this(), motor = place.motor, step_number = place.step,
              leaves](const OtherCourses& courses) {
                 return courses.to([&](Node other) {
                     return is_stuck(other, step_number) && explorer_.place(other).motor == motor &&
                            leaves_step(other) == leaves;
                 });
             }});
    }

    /// Scans with ERROR in which no term writes outputs.
    void find_outputs_left_on() {
        const auto leaves_outputs = [&explorer = explorer_](const Explorer::Edge& edge) {
            const Group& group = explorer.group_of(edge);
            return group.error && !group.outcome.outputs;
        };
        std::array<bool, 63> told{};
        for (Node node = 0; node < explorer_.size(); ++node) {
            const Place& place = explorer_.place(node);
            if (place.outputs == 0 || is_fault_step_[place.step] || told[place.step]) continue;
            const auto edges = explorer_.edges_from(node);
            const auto left = std::find_if(edges.begin(), edges.end(), leaves_outputs);
            if (left == edges.end()) continue;
            auto way = courses_.with(*left);
            if (!way) continue;
            told[place.step] = true;
            findings_.push_back({"V006", place.step,
                                 fmt::format("in step {} ERROR leaves {} on", step_name(names_, place.step),
                                             outputs_text(place.outputs, names_)),
                                 std::move(*way),
                                 [=, &explorer = explorer_, step = place.step,
                                  outputs = place.outputs](const OtherCourses& courses) {
                                     return courses.with([&](const Explorer::Edge& edge) {
                                         const Place& from = explorer.place(edge.from);
                                         return from.step == step && from.outputs == outputs &&
                                                leaves_outputs(edge);
                                     });
                                 }});
        }
    }

    const Explorer& explorer_;
    const Machine& machine_;
    const Names& names_;
    Courses& courses_;
    std::array<bool, 64> is_fault_step_{};
    std::vector<bool> resets_;
    std::vector<Finding> findings_;
};

}  // namespace

std::vector<Finding> check_errors(const Subject& subject) {
    return std::make_shared<Errors>(subject)->find();
}

}  // namespace nplc::verify
