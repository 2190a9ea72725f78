// Hours of a gateway with its motor on a bad line, an operator, a person's program and power cuts, watched at
// every scan; and faults put in, to see that they are found and made short.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <numeric>

#include "shrink.h"
#include "soak_run.h"

namespace nplc::soak {
namespace {

using namespace std::chrono_literals;

/// Of the environment, for longer runs and to see one seed again.
std::uint64_t number(const char* name, std::uint64_t otherwise) {
    const char* const given = std::getenv(name);
    return given == nullptr ? otherwise : std::strtoull(given, nullptr, 10);
}

constexpr Time kTail = 3s;  ///< in which what the last disturbance did shows

const sim::Program& program() {
    static const sim::Program loaded = sim::load_program(NPLC_SOAK_PROGRAM);
    return loaded;
}

std::optional<Breach> play(const Course& course, std::uint64_t seed, Time end, Fault fault) {
    return std::make_unique<SoakRun>(program(), seed, fault)->play(course, end);
}

struct Found {
    Breach breach;
    Course course;
    std::string scenario;
};

/// The shortest course that breaks the same.
Found shrunk(const Course& course, std::uint64_t seed, const Breach& breach, Fault fault) {
    Course until = course;
    std::erase_if(until, [&](const Disturbance& what) { return what.at > breach.at; });
    std::size_t plays = 0;
    Breach last = breach;
    const auto fails = [&](const Course& shorter) {
        ++plays;
        const Time end = shorter.empty() ? kFirst : shorter.back().at + kTail;
        const auto found = play(shorter, seed, end, fault);
        return found && found->invariant == breach.invariant;
    };
    Found found{breach, shrink(until, fails), {}};
    const Time end = found.course.empty() ? kFirst : found.course.back().at + kTail;
    found.breach = play(found.course, seed, end, fault).value_or(last);
    found.scenario = scenario_of(
        found.course, seed, end,
        fmt::format("seed {}: breaks \"{}\" at {:.3f} ms: {}", seed, name_of(found.breach.invariant),
                    static_cast<double>(found.breach.at.count()) / 1e6, found.breach.what));
    fmt::print("{} disturbances became {} in {} plays:\n{}\n", until.size(), found.course.size(), plays,
               found.scenario);
    return found;
}

std::vector<std::uint64_t> seeds() {
    if (const std::uint64_t one = number("NPLC_SOAK_SEED", 0); one != 0) return {one};
    std::vector<std::uint64_t> all(number("NPLC_SOAK_SEEDS", 1));
    std::iota(all.begin(), all.end(), 1U);
    return all;
}

TEST(Soak, NothingThatMustHoldIsBroken) {
    const std::uint64_t minutes = number("NPLC_SOAK_MINUTES", NPLC_SOAK_MINUTES);
    const Time length = std::chrono::minutes{minutes};
    for (const std::uint64_t seed : seeds()) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const Course course = random_course(seed, length);
        const auto run = std::make_unique<SoakRun>(program(), seed, Fault::none);
        const auto breach = run->play(course, length);
        const Statistics seen = run->statistics();
        fmt::print(
            "seed {}: {} disturbances, {} orders executed, {} scans that did something, {} starts, {} torn "
            "operations of the storage, {} tables stored, {} answers to the person, {} orders excused, heap "
            "{} "
            "to {} bytes\n",
            seed, seen.disturbances, seen.orders, seen.scans, seen.starts, seen.torn, seen.stored,
            seen.answers, seen.excused, seen.early_heap, seen.late_heap);
        if (breach) {
            const Found found = shrunk(course, seed, *breach, Fault::none);
            FAIL() << name_of(breach->invariant) << ": " << breach->what << "\n" << found.scenario;
        }
        EXPECT_GT(seen.disturbances, 5 * minutes);
        EXPECT_GT(seen.orders, 20 * minutes) << "the machine hardly moved";
        EXPECT_GT(seen.stored, minutes / 10);
        EXPECT_GT(seen.starts, minutes / 10);
        EXPECT_GT(seen.answers, 2 * minutes);
        EXPECT_LT(seen.excused, seen.orders / 1000 + 10);
        EXPECT_LE(seen.late_heap, seen.early_heap + 16 * 1024) << "memory grows";
    }
}

class SoakFinds : public testing::TestWithParam<std::pair<Fault, Invariant>> {};

TEST_P(SoakFinds, AFaultAndMakesItShort) {
    constexpr std::uint64_t kSeed = 7;
    constexpr Time kAtMost = 2h;
    const auto [fault, invariant] = GetParam();
    const Course course = random_course(kSeed, kAtMost);
    const auto breach = play(course, kSeed, kAtMost, fault);
    ASSERT_TRUE(breach) << "not found in two hours";
    EXPECT_EQ(breach->invariant, invariant) << breach->what;
    const Found found = shrunk(course, kSeed, *breach, fault);
    EXPECT_LE(found.course.size(), 6U);
    EXPECT_EQ(found.breach.invariant, invariant);
    EXPECT_FALSE(play(found.course, kSeed, found.course.back().at + kTail, Fault::none))
        << "it is the fault that breaks it";

    const auto parsed = sim::parse_scenario(found.scenario, "shrunk.scn", program().names);
    for (const sim::Mistake& mistake : parsed.mistakes)
        ADD_FAILURE() << mistake.place() << ' ' << mistake.message;
    const bool all_words =
        std::ranges::all_of(found.course, [](const Disturbance& w) { return has_words(w.kind); });
    if (!all_words) return;
    const auto again = std::make_unique<SoakRun>(program(), kSeed, fault)->play(parsed.scenario);
    ASSERT_TRUE(again) << "the scenario breaks nothing:\n" << found.scenario;
    EXPECT_EQ(again->invariant, invariant);
}

using FaultAndInvariant = std::pair<Fault, Invariant>;

INSTANTIATE_TEST_SUITE_P(All, SoakFinds,
                         testing::Values(FaultAndInvariant(Fault::order_lost, Invariant::orders),
                                         FaultAndInvariant(Fault::order_twice, Invariant::orders),
                                         FaultAndInvariant(Fault::erase_astray, Invariant::store)));

/// The rules of the shrinking itself, on what is quickly judged: 3 of 1,000 matter, in their order.
TEST(Shrink, FindsTheFewThatMatter) {
    Course course = random_course(3, 3h);
    ASSERT_GT(course.size(), 1'000U);
    course.resize(1'000);
    course[100] = {course[100].at, Kind::load, 1'001};
    course[517] = {course[517].at, Kind::load, 1'002};
    course[999] = {course[999].at, Kind::load, 1'003};
    const Course found = shrink(course, [](const Course& shorter) {
        unsigned next = 1'001;
        for (const Disturbance& what : shorter)
            next += what.kind == Kind::load && what.value == next ? 1U : 0U;
        return next == 1'004;
    });
    ASSERT_EQ(found.size(), 3U);
    EXPECT_EQ(found[2].value, 1'003U);
    EXPECT_LE(found[2].at, 3ms) << "no pause is longer than it must be";
}

TEST(Course, TheSameSeedIsTheSameCourseAndALongerOneGoesOn) {
    const Course one = random_course(1, 10min);
    EXPECT_EQ(one, random_course(1, 10min));
    EXPECT_NE(one, random_course(2, 10min));
    const Course longer = random_course(1, 20min);
    ASSERT_GT(longer.size(), one.size());
    EXPECT_TRUE(std::equal(one.begin(), one.end() - 20, longer.begin()))
        << "but for what begins before the end";
}

}  // namespace
}  // namespace nplc::soak
