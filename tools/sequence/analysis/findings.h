#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/checks.h"
#include "explorer.h"
#include "walk.h"

/// The built-in checks, grouped by subject.
namespace nplc::verify {

using Scans = std::vector<CourseScan>;

/// Finds other courses that show the same as a finding: of those that are not excluded the shortest.
class OtherCourses {
  public:
    /// `distances`: for each node the scans to the finding's step, in whose scans they begin or end.
    OtherCourses(const Explorer& explorer, Excluded& excluded, const std::vector<std::uint32_t>& distances)
        : explorer_(explorer), excluded_(excluded), distances_(distances) {}

    Excluded& excluded() const { return excluded_; }
    /// To be led with `begin_..` and `all`.
    Walk walk() const { return Walk(explorer_, &excluded_, &distances_); }

    /// Up to and with a scan that `shows(edge)`.
    template <class Shows>
    std::optional<Scans> with(const Shows& shows) const {
        std::optional<Scans> course;
        Walk walk = this->walk();
        walk.begin_at_power_up(0);
        walk.all([&](const Walk::Scan& scan) {
            if (!shows(scan.edge)) return scan.go_on(0);
            course = scan.course(scan.images());
            scan.stop();
        });
        return course;
    }
    /// To a node that `shows(node)`, and on with some scans.
    template <class Shows>
    std::optional<Scans> to(const Shows& shows, const Scans& then = {}) const {
        std::optional<Scans> course;
        if (shows(Explorer::Node{0}) && may_begin_with(then)) return then;
        Walk walk = this->walk();
        walk.begin_at_power_up(0);
        walk.all([&](const Walk::Scan& scan) {
            if (!shows(scan.edge.to) || !scan.may_go_on_with(then)) return scan.go_on(0);
            course = scan.course(scan.images());
            course->insert(course->end(), then.begin(), then.end());
            scan.stop();
        });
        return course;
    }

  private:
    bool may_begin_with(const Scans& scans) const {
        Excluded::State state = 0;
        for (const CourseScan& scan : scans)
            state = state == Excluded::kOut ? state : excluded_.next(state, scan);
        return !scans.empty() && state != Excluded::kOut;
    }

    const Explorer& explorer_;
    Excluded& excluded_;
    const std::vector<std::uint32_t>& distances_;
};

using Other = std::function<std::optional<Scans>(const OtherCourses&)>;

/// A check that found something.
struct Finding {
    std::string_view code;
    std::uint8_t step = 0;
    std::string reason;
    Scans way;      ///< the course that shows it; may be empty
    Other other{};  ///< while the explorer is there
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

/// For each node, the least scans to the beginning of one of the step; kFar if there are none.
std::vector<std::uint32_t> distances_to_step(const Explorer& explorer, const EdgesBack& back,
                                             std::uint8_t step);

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
