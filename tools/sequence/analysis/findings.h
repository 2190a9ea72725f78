#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/checks.h"
#include "explorer.h"
#include "walk.h"

/// The built-in checks, grouped by subject.
namespace nplc::verify {

/// A check that found something.
struct Finding {
    std::string_view code;
    std::uint8_t step = 0;
    std::string reason;
    std::vector<CourseScan> way;  ///< the course that shows it; may be empty
};

/// Courses to places; with `excluded`, others than these.
class Courses {
  public:
    explicit Courses(const Explorer& explorer, Excluded* excluded = nullptr)
        : explorer_(explorer), excluded_(excluded) {}
    Excluded* excluded() const { return excluded_; }
    /// A course to a node and on with some scans; empty if all are excluded.
    std::optional<std::vector<CourseScan>> to(Explorer::Node node, std::vector<CourseScan> then = {});
    /// Up to and including the scan of an edge.
    std::optional<std::vector<CourseScan>> with(const Explorer::Edge& edge) {
        return to(edge.from, {explorer_.scan_of(edge, explorer_.images_of(edge))});
    }

  private:
    const Explorer& explorer_;
    Excluded* excluded_;
    std::optional<Walk> walk_;
};

/// The input of the checks: all reachable states, with edges.
struct Subject {
    const Explorer& explorer;
    const Names& names;
    Courses& courses;
    /// Motor registers that a permitted value makes 0, whatever the table writes.
    const std::vector<std::uint8_t>& may_be_zero;
};

std::vector<Finding> check_steps(const Subject& subject);
std::vector<Finding> find_rounds(const Subject& subject);
std::vector<Finding> check_errors(const Subject& subject);
std::vector<Finding> check_zeros(const Subject& subject);
std::vector<Finding> check_motor(const Subject& subject);

using Steps = std::uint64_t;  ///< a bit for each

constexpr Steps bit_of(std::uint8_t step) {
    return Steps{1} << step;
}
std::string names_of(Steps steps, const Names& names);

/// For which images a scan of a step does something else when the timer (the counter) is zero, or when INPOS
/// is on.
class Sensitivity {
  public:
    explicit Sensitivity(const Machine& machine);

    const ImageSet& to_timer(std::uint8_t step, bool counter_zero) const {
        return timer_[step * 2U + (counter_zero ? 1U : 0U)];
    }
    const ImageSet& to_counter(std::uint8_t step, bool timer_zero) const {
        return counter_[step * 2U + (timer_zero ? 1U : 0U)];
    }
    bool tests_timer(std::uint8_t step) const { return (to_timer(step, false) | to_timer(step, true)).any(); }
    bool tests_in_pos(std::uint8_t step) const { return in_pos_[step]; }

  private:
    std::vector<ImageSet> timer_;
    std::vector<ImageSet> counter_;
    std::vector<bool> in_pos_;
};

}  // namespace nplc::verify
