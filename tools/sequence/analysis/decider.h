#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "analysis/verify.h"
#include "concretize.h"
#include "course_search.h"
#include "ways_back.h"

namespace nplc::verify {

std::string out_of_bounds(const Explorer& explorer);

/// Decides whether a scan is reachable, by increasingly exact explorations: first with the timer as zero or
/// running, then in milliseconds if that finds a course that no times fit.
class Decider {
  public:
    Decider(const sequencer::Table& table, const Machine& machine, const Options& options,
            std::vector<Target> targets);

    enum class Answer : std::uint8_t { can_be, cannot_be, unknown };
    struct Finding {
        Answer answer = Answer::unknown;
        std::optional<Played> played{};
        std::string why{};       ///< the reason if it is unknown
        std::string conflict{};  ///< of the last course that was tried, as text
    };
    /// The next course that is not excluded.
    using Ask = std::function<std::optional<Way>(Excluded&)>;
    static constexpr int kMostTries = 1000;
    /// One course after the other, until times fit one or `excluded` is exhausted.
    Finding tried(Excluded& excluded, const Ask& ask) const;

    Finding scan_of_target(std::size_t target);
    Finding missed_deadline(const Property& property);
    Finding remembered(const Property& property);
    Finding stuck_outside(std::size_t index);
    /// A course after which the target can be reached by way of ERROR alone, if one was found.
    std::optional<Played> course_to_only_by_error(std::size_t target) const;
    /// Whether no course without ERROR reaches the target.
    bool is_reached_only_by_error(std::size_t target) const;

    const Explorer& coarse() const { return *coarse_; }

    /// Whether the target, which is reached with some values of the ranges, is certainly reached with each.
    bool is_reached_with_all(std::size_t target) const;

    std::optional<Played> realized(const std::vector<CourseScan>& scans,
                                   const std::optional<Overdue>& overdue = {}) const {
        return attempted({scans, overdue}).played;
    }

  private:
    struct Attempted {
        std::optional<Played> played{};
        Conflict conflict{};
    };
    Attempted attempted(const Way& way) const;
    Finding explored_scan(std::size_t target);
    Finding explored_deadline(const Property& property) const;
    Finding explored_deadline(const Property& property, const Precision& precision) const;
    Finding explored_memory(const Property& property);
    Finding explored_stuck(const Target& target, Stuck& stuck);
    /// An undecided course is resolved by trying others.
    Finding or_tried(Finding open, const Explorer& explorer, const Ask& ask) const;
    const Explorer& fine();
    const Explorer& punctual();
    bool assumes_stable_inputs() const;
    /// Why ALWAYS POSSIBLE is undecided, with the assumption that leads to it.
    std::string why_not_surely(const Target& target, const ScanKeys* only = nullptr) const;
    bool has_ranges() const { return !machine_.ranges().timer.empty() || machine_.has_counter_ranges(); }

    const sequencer::Table& table_;
    const Machine& machine_;
    const Options& options_;
    std::vector<Target> targets_;
    std::unique_ptr<Explorer> coarse_;
    std::unique_ptr<Explorer> fine_;
    std::unique_ptr<Explorer> punctual_;  ///< as coarse_, but no scan waits for the line to be restored
    std::array<std::uint32_t, 6> stable_ms_{};
    std::uint8_t held_ = 0;  ///< inputs that are assumed to keep their levels longer than each does anyway
};

}  // namespace nplc::verify
