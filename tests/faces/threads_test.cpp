// An axis's model between its loop and faces' threads, compiled with ThreadSanitizer.
#include <gtest/gtest.h>

#include <array>
#include <thread>

#include "faces/axis_model.h"
#include "registers/gateway.h"

namespace nplc::faces {
namespace {

namespace gw = registers::gateway;

constexpr unsigned kCommands = 200;
constexpr base::Instant kNow{base::Milliseconds(1'000)};

/// Ends every command with its own value, and puts images meanwhile, until the faces have gone.
void run_loop(AxisModel& model, const std::atomic<int>& faces) {
    AxisImage image;
    while (faces != 0) {
        model.arm_loop();
        base::Ring<std::uint64_t, CommandDesk::kMostClients> leavers;
        static_cast<void>(model.desk().take_leavers(leavers));
        std::optional<CommandDesk::Work> work;
        static_cast<void>(model.desk().take(work, image.number % 2 == 0));
        while (work && !model.desk().end(*work, {.id = work->id, .value = work->command.value})) {
        }
        ++image.number;
        image.own.fill(static_cast<std::uint32_t>(image.number));
        if (model.is_wanted(kNow)) model.board().put(image);
        const std::array<std::uint8_t, 4> table{};
        static_cast<void>(model.table_shelf().put(std::make_shared<const AxisTable>(
            AxisTable{static_cast<std::uint32_t>(image.number), {table.begin(), table.end()}})));
        model.strike_bells();
        std::this_thread::yield();
    }
}

/// How many commands ended as they should.
unsigned run_face(AxisModel& model, Bell& bell) {
    unsigned good = 0;
    auto client = model.join(Side::plant, "face", bell);
    for (unsigned i = 0; i < kCommands; ++i) {
        if (i % 100 == 0) client = model.join(Side::plant, "face", bell);
        const auto id = client->submit(Command::own(gw::BREAK_LOW, i, kNow));
        std::optional<Completion> ended;
        while (!ended) {
            bell.arm();
            const AxisImage image = model.image(kNow);
            if (image.own.front() != image.own.back()) return 0;
            ended = client->take();
            std::this_thread::yield();
        }
        good += ended->id == id && ended->value == i ? 1U : 0U;
        if (model.table()->bytes.size() > 4) return 0;
    }
    return good;
}

TEST(AxisModel, ServesAFaceInEachOfTwoThreads) {
    AxisModel model("x");
    Bell loop([] {});
    std::array<Bell, 2> bells{Bell([] {}), Bell([] {})};
    model.wake_loop_with(loop);
    for (Bell& bell : bells) model.watch(bell);
    std::atomic<int> faces{2};
    std::array<unsigned, 2> good{};
    std::thread axis([&] { run_loop(model, faces); });
    std::array<std::thread, 2> threads;
    for (std::size_t i = 0; i < 2; ++i) {
        threads[i] = std::thread([&, i] {
            good[i] = run_face(model, bells[i]);
            --faces;
        });
    }
    for (std::thread& thread : threads) thread.join();
    axis.join();
    EXPECT_EQ(good[0], kCommands);
    EXPECT_EQ(good[1], kCommands);
}

}  // namespace
}  // namespace nplc::faces
