#pragma once

#include <optional>
#include <vector>

#include "conflict.h"
#include "explorer.h"

namespace nplc::verify {

/// Ways to a target on which no ERROR begins: a scan reads one only where the scan before read it too.
/// `explorer` must have all edges.
class ErrorWays {
  public:
    ErrorWays(const Explorer& explorer, const Target& target);

    /// From power-up on.
    bool lead_from_power_up_only_by_error() const { return !can(0, false); }
    /// The shortest course after which every way to the target begins an ERROR, or there is none. With
    /// `excluded` the shortest that is not excluded.
    std::optional<std::vector<CourseScan>> course_to_only_by_error(Excluded* excluded = nullptr) const;

  private:
    /// The scan before it read ERROR, or not.
    bool can(Explorer::Node node, bool in_error) const { return (can_[node] & bit(in_error)) != 0; }
    static std::uint8_t bit(bool in_error) { return in_error ? 2 : 1; }
    bool sweep();
    void find_stuck();

    struct Scan {
        bool calm = false;   ///< it can be without ERROR
        bool error = false;  ///< with one
        std::uint8_t hits = 0;
    };

    const Explorer& explorer_;
    const Target& target_;
    std::vector<Scan> scans_;          ///< by edge
    std::vector<std::uint8_t> can_;    ///< by node
    std::vector<std::uint8_t> stuck_;  ///< by edge: after it, without or with ERROR, nothing leads there
};

}  // namespace nplc::verify
