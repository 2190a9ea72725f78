// Power fails in every operation of an update, of its trial and of its confirmation, in every way that
// tears_of names: an image is started, the old or the new one, and an update is taken afterwards.

#include <iostream>

#include "bench.h"

namespace nplc::update {
namespace {

struct Counted {
    std::uint64_t cases = 0;
    std::uint64_t old_runs = 0;
    std::uint64_t new_runs = 0;
};

std::ostream& operator<<(std::ostream& out, const Counted& count) {
    return out << count.cases << " cases, old image " << count.old_runs << ", new image " << count.new_runs;
}

/// `what` happens on a copy of the device; `at_cut` gets the device of every cut. `few`: of an operation only
/// some tears.
template <class What, class AtCut>
sim::SimStorage cut_everywhere(const sim::SimStorage& start, const Shape& shape, bool few, What what,
                               AtCut at_cut) {
    sim::SimStorage device(start);
    device.watch([&](const sim::StorageOperation& operation) {
        const auto tears = sim::tears_of(operation, shape.geometry);
        const std::size_t step = few ? std::max<std::size_t>(1, tears.size() / 5) : 1;
        for (std::size_t i = 0; i < tears.size(); i += step) at_cut(device.torn(operation, tears[i]));
    });
    what(device);
    device.watch(nullptr);
    EXPECT_EQ(device.programmed_twice(), 0U) << shape.name;
    return device;
}

void update_to(sim::SimStorage& device, const Shape& shape, unsigned running, unsigned version) {
    Receiver receiver(device, shape.layout, kBoard, running);
    EXPECT_EQ(send(receiver, firmware(version, 1U - running)), Result::done) << shape.name;
}

void confirm(sim::SimStorage& device, const Shape& shape, unsigned running) {
    Receiver receiver(device, shape.layout, kBoard, running);
    receiver.confirm();
    for (int i = 0; i < 10; ++i) receiver.poll();
    EXPECT_TRUE(receiver.is_confirmed()) << shape.name;
}

/// Slot 0 is the old one. The slot that was started.
unsigned expect_start(sim::SimStorage& device, const Shape& shape, Counted& count) {
    const auto start = boot(device, shape.layout);
    ++count.cases;
    EXPECT_TRUE(start) << shape.name << ", case " << count.cases;
    if (!start) return 0;
    ++(start->slot == 0 ? count.old_runs : count.new_runs);
    return start->slot;
}

/// What slot 1 can hold before an update.
std::vector<sim::SimStorage> beginnings(const Shape& shape) {
    sim::SimStorage first(shape.geometry);
    install(first, shape.layout, 0, firmware(2, 0), kConfirmed);
    sim::SimStorage older(first);
    install(older, shape.layout, 1, firmware(1, 1), kConfirmed);
    sim::SimStorage failed(first);
    install(failed, shape.layout, 1, firmware(3, 1), {.complete = true, .tries = kTries});
    return {first, older, failed};
}

TEST(UpdatePowerCut, InAnUpdateAnImageIsStartedAndTheNextUpdateIsTaken) {
    for (const Shape& shape : shapes()) {
        Counted count;
        bool few = shape.layout.unit() != 4;  // of the first shape's first beginning all
        for (const sim::SimStorage& start : beginnings(shape)) {
            const auto after = [&](sim::SimStorage device) {
                if (expect_start(device, shape, count) != 0 || count.cases % 16 != 0) return;
                update_to(device, shape, 0, 3);
                EXPECT_EQ(boots(device, shape.layout), "1 on trial")
                    << shape.name << ", case " << count.cases;
                EXPECT_EQ(device.programmed_twice(), 0U);
            };
            auto done = cut_everywhere(
                start, shape, few, [&](auto& device) { update_to(device, shape, 0, 3); }, after);
            EXPECT_EQ(boots(done, shape.layout), "1 on trial");
            few = true;
        }
        EXPECT_GT(count.old_runs, count.new_runs);
        EXPECT_GT(count.new_runs, 0U);
        std::cout << shape.name << ": " << count << '\n';
    }
}

TEST(UpdatePowerCut, InATrialAndItsConfirmationAnImageIsStarted) {
    for (const Shape& shape : shapes()) {
        Counted count;
        sim::SimStorage stored = beginnings(shape).front();
        update_to(stored, shape, 0, 3);
        const auto after = [&](sim::SimStorage device) { expect_start(device, shape, count); };
        const auto tried = cut_everywhere(
            stored, shape, false, [&](auto& device) { boot(device, shape.layout); }, after);
        const auto confirmed = cut_everywhere(
            tried, shape, false, [&](auto& device) { confirm(device, shape, 1); },
            [&](sim::SimStorage device) {
                if (expect_start(device, shape, count) == 1) confirm(device, shape, 1);
                EXPECT_EQ(device.programmed_twice(), 0U);
            });
        sim::SimStorage last(confirmed);
        EXPECT_EQ(boots(last, shape.layout), "1");
        EXPECT_EQ(count.old_runs, 0U) << "three starts are not used up by one cut";
        std::cout << shape.name << ": " << count << '\n';
    }
}

/// The course of a machine: update, trial, confirmation, the next update back into slot 0; a cut in any
/// operation, then the same course from where it stands, with a second cut.
void go_on(sim::SimStorage& device, const Shape& shape) {
    const auto start = boot(device, shape.layout);
    ASSERT_TRUE(start) << shape.name;
    const unsigned running = start->slot;
    if (start->on_trial) confirm(device, shape, running);
    const std::uint32_t version = look(device, shape.layout, running, kBoard).header->version;
    if (version >= 4 || (version == 3) != (running == 1)) return;
    update_to(device, shape, running, version + 1);
    const auto next = boot(device, shape.layout);
    ASSERT_TRUE(next && next->slot != running && next->on_trial) << shape.name;
    confirm(device, shape, next->slot);
}

TEST(UpdatePowerCut, TwiceInTwoUpdatesAnImageIsStarted) {
    const Shape shape = shapes().front();
    Counted first;
    Counted second;
    const sim::SimStorage start = beginnings(shape).front();
    const auto course = [&](sim::SimStorage& device) {
        go_on(device, shape);
        go_on(device, shape);
    };
    auto end = cut_everywhere(start, shape, true, course, [&](sim::SimStorage device) {
        sim::SimStorage looked(device);
        expect_start(looked, shape, first);
        if (first.cases % 15 != 0) return;
        auto end_of_second = cut_everywhere(
            device, shape, true, course, [&](sim::SimStorage again) { expect_start(again, shape, second); });
        EXPECT_EQ(boots(end_of_second, shape.layout), "0");
    });
    EXPECT_EQ(boots(end, shape.layout), "0");
    EXPECT_EQ(look(end, shape.layout, 0, kBoard).header->version, 4U);
    EXPECT_GT(second.cases, first.cases);
    std::cout << shape.name << ": first cut " << first << "; second cut " << second << '\n';
}

}  // namespace
}  // namespace nplc::update
