// Power fails at every operation of an upload, and at every pair of operations of two uploads, in every way
// that tears_of names: what runs afterwards is the old table or the new one.

#include <gtest/gtest.h>

#include <iostream>

#include "store_bench.h"

namespace nplc::store {
namespace {

struct Counted {
    std::uint64_t cases = 0;
    std::uint64_t old_runs = 0;
    std::uint64_t new_runs = 0;
};

std::ostream& operator<<(std::ostream& out, const Counted& count) {
    return out << count.cases << " cases, old table " << count.old_runs << ", new table " << count.new_runs;
}

/// Uploads `next` to a copy of `start`; calls `at_cut` with the device of every cut there is.
template <class AtCut>
void cut_everywhere(const sim::SimStorage& start, const Shape& shape, const Bytes& next, AtCut at_cut) {
    sim::SimStorage device(start);
    device.watch([&](const sim::StorageOperation& operation) {
        for (const sim::Tear& tear : sim::tears_of(operation, shape.geometry))
            at_cut(device.torn(operation, tear));
    });
    Session session(device, shape.area);
    ASSERT_EQ(session.write(next), Phase::done) << shape.name;
    EXPECT_EQ(session.content(), next);
    EXPECT_EQ(device.programmed_twice(), 0U) << shape.name;
}

/// What runs on the device must be one of the two; counts which.
bool expect_old_or_new(sim::SimStorage& device, const Shape& shape, const std::optional<Bytes>& old,
                       const Bytes& next, Counted& count) {
    Session session(device, shape.area);
    EXPECT_TRUE(session.mounted);
    if (old) {
        EXPECT_FALSE(session.slots.is_fallback()) << shape.name << ", case " << count.cases;
    }
    const auto runs = session.content();
    ++count.cases;
    count.old_runs += runs == old ? 1U : 0U;
    count.new_runs += runs == next ? 1U : 0U;
    EXPECT_TRUE(runs == old || runs == next) << shape.name << ", case " << count.cases;
    return runs == next;
}

const Bytes kFirst = table_of(10, 1);
const Bytes kSecond = table_of(7, 2);
const Bytes kThird = table_of(9, 3);
const Bytes kFourth = table_of(8, 4);

TEST(PowerCut, OnceInALongUploadTheOldOrTheNewTableRunsAndANewUploadIsTaken) {
    const Bytes old = table_of(180, 1);
    const Bytes next = table_of(200, 2);
    for (const Shape& shape : shapes(static_cast<std::uint32_t>(next.size()))) {
        Counted count;
        cut_everywhere(device_with(shape, {next, old}), shape, next, [&](sim::SimStorage device) {
            expect_old_or_new(device, shape, old, next, count);
            if (count.cases % 16 != 0) return;
            Session again(device, shape.area);
            EXPECT_EQ(again.write(kThird), Phase::done);
            EXPECT_EQ(Session(device, shape.area).content(), kThird);
            EXPECT_EQ(device.programmed_twice(), 0U);
        });
        EXPECT_GT(count.new_runs, 0U);
        EXPECT_GT(count.old_runs, count.new_runs);
        std::cout << shape.name << ": " << count << '\n';
    }
}

TEST(PowerCut, OnceInTheFirstUploadEverThereIsNoTableOrTheNewOne) {
    for (const Shape& shape : shapes(100)) {
        Counted count;
        cut_everywhere(sim::SimStorage(shape.geometry), shape, kFirst, [&](sim::SimStorage device) {
            expect_old_or_new(device, shape, std::nullopt, kFirst, count);
        });
        EXPECT_GT(count.new_runs, 0U);
        std::cout << shape.name << ": " << count << '\n';
    }
}

TEST(PowerCut, TwiceInTwoUploadsNoTableIsLostAndNoneIsMixed) {
    for (const Shape& shape : shapes(static_cast<std::uint32_t>(kFirst.size()))) {
        Counted first;
        Counted second;
        const auto start = device_with(shape, {kFirst, kSecond});
        cut_everywhere(start, shape, kThird, [&](sim::SimStorage device) {
            const Bytes& then = expect_old_or_new(device, shape, kSecond, kThird, first) ? kThird : kSecond;
            cut_everywhere(device, shape, kFourth, [&](sim::SimStorage again) {
                expect_old_or_new(again, shape, then, kFourth, second);
            });
        });
        std::cout << shape.name << ": first cut " << first << "; second cut " << second << '\n';
    }
}

}  // namespace
}  // namespace nplc::store
