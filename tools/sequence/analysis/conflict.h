#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <tuple>
#include <unordered_map>
#include <vector>

#include "explorer.h"

namespace nplc::verify {

/// Scans of a course that no times permit together.
struct Conflict {
    std::size_t first = 0;
    std::size_t last = 0;
    bool exact = false;    ///< only these very scans: the images chosen have to do with it
    bool overdue = false;  ///< a deadline that begins with the first cannot be over after the last
    std::string words{};

    /// Both, of the same course.
    void join(const Conflict& other);
};

/// Excluded courses: those with scans that conflict, described by what determines the times.
class Excluded {
  public:
    /// How far the scans so far match each conflict.
    using State = std::uint32_t;
    static constexpr State kOut = ~State{0};

    explicit Excluded(const Explorer& explorer) : explorer_(explorer) { forget(); }

    void add(std::span<const CourseScan> scans, const Conflict& conflict);
    /// After one more scan; kOut if the course is excluded. `begins`: a deadline, with this scan.
    State next(State before, const Explorer::Edge& edge, bool begins = false);
    State next(State before, const CourseScan& scan);
    /// A course that has its deadline missed after this scan is excluded.
    bool ends_out(State before, const Explorer::Edge& edge, bool begins);

    /// What is excluded stays so; the work begins again.
    void begin_question() { work_ = 0; }
    /// Scans examined; limits the search for the courses of a question.
    void count_work(std::uint64_t scans = 1) { work_ += scans; }
    bool is_worn_out() const { return work_ > kMostWork; }

  private:
    static constexpr std::uint64_t kMostWork = 2'000'000;
    static constexpr std::uint32_t kWhatever = ~std::uint32_t{0};

    struct Symbol {
        std::uint32_t times = kWhatever;
        std::uint32_t exact = kWhatever;
        bool begins = false;
    };
    struct Element {
        std::uint32_t times = kWhatever;
        std::uint32_t exact = kWhatever;
        bool begins = false;  ///< to be looked at if it is set
        bool operator==(const Element&) const = default;
    };
    struct Pattern {
        std::vector<Element> elements;
        bool at_end = false;
        bool operator==(const Pattern&) const = default;
    };
    using Items = std::vector<std::pair<std::uint32_t, std::uint32_t>>;  ///< pattern, matched elements
    using TimesKey = std::tuple<std::int32_t, std::int32_t, std::uint32_t, std::uint32_t, unsigned>;
    using ExactKey = std::tuple<std::uint64_t, std::uint32_t, std::uint32_t, std::int32_t>;

    void forget();
    Symbol symbol_of(const CourseScan& scan);
    const Symbol& symbol_of(const Explorer::Edge& edge);
    State next(State before, const Symbol& symbol, bool is_end);
    State state_of(Items items);

    const Explorer& explorer_;
    std::vector<Pattern> patterns_;
    std::map<TimesKey, std::uint32_t> times_;
    std::map<ExactKey, std::uint32_t> exact_;
    std::vector<Symbol> symbols_;  ///< by edge
    std::vector<Items> states_;
    std::map<Items, State> state_numbers_;
    std::unordered_map<std::uint64_t, State> known_;
    std::uint64_t work_ = 0;
};

}  // namespace nplc::verify
