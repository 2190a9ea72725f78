// The motor's one access, shared by the user's port and the faces, on the simulated board in virtual time.
#include <gtest/gtest.h>

#include "base/bytes.h"
#include "faces/axis_loop.h"
#include "registers/mac.h"
#include "sim/world.h"

namespace nplc::faces {
namespace {

namespace gw = registers::gateway;
namespace mactalk = protocol::mactalk;
using sim::Time;
using namespace std::chrono_literals;

/// Step 0 writes P_SOLL while IN0 is off, so that orders come as fast as they are executed.
const std::vector<std::uint8_t> kBusyTable{
    0xC0, 0, 0x81, 0x80 | registers::P_SOLL, 1, 0, 0, 0, 0x3F, 0, 0, 0, 0, 0, 0, 0};
/// Step 0 goes to step 1, which stays.
const std::vector<std::uint8_t> kQuietTable{0xC0, 0, 0, 0x01, 0x80, 0, 0, 0, 0xC1, 0, 0, 0x3E,
                                            0x80, 1, 0, 0,    0x3F, 0, 0, 0, 0,    0, 0, 0};

/// A client of the gateway's port that reads motor registers and never pauses for longer than `gap`: what a
/// listener with one client does, and with 0 what one with many does.
struct Reader {
    mactalk::Kind kind = mactalk::Kind::read;
    Time gap{};
};

struct SharedMotor {
    SharedMotor(const std::vector<std::uint8_t>& table, bool runs, const Reader& reader)
        : client(reader),
          world(table, {.faults = {}, .gateway = {.autostart = runs}, .user_submits = true}) {}

    /// In the order of a Linux board: the client's message, the controller, its answer, the faces.
    void step(Time end) {
        world.step(client_reads && !asked_ ? std::min(end, std::max(world.now(), next_)) : end);
        gateway::UserPort& port = world.controller().user_port();
        port.serve(world.instant());
        if (asked_ && !port.is_serving()) {
            const auto reply = port.take_reply();
            ++(reply.empty() ? refusals : answers);
            last_reply.assign(reply.begin(), reply.end());
            asked_ = false;
            next_ = world.now() + client.gap;
        }
        if (has_faces && world.now() >= faces_due_) {
            faces_due_ = world.now() + faces_every;
            loop.poll(world.controller(), world.instant(), world.instant());
        }
        if (!client_reads || asked_ || world.now() < next_) return;
        port.submit({.kind = client.kind, .address = world.motor_address(), .reg = registers::P_IST}, {},
                    world.instant());
        asked_ = true;
    }
    void run(Time time) {
        for (const Time end = world.now() + time; world.now() < end;) step(end);
    }
    /// The causes, asked for ten times a second; null if they do not come within `time`.
    std::shared_ptr<const Findings> causes(Time time) {
        std::shared_ptr<const Findings> found;
        for (const Time end = world.now() + time; world.now() < end && found == nullptr;) {
            run(100ms);
            static_cast<void>(model.image_with_why(world.instant(), &found));
        }
        return found;
    }

    Reader client;
    sim::World world;
    bool client_reads = true;
    bool has_faces = true;
    Time faces_every{};
    unsigned answers = 0;
    unsigned refusals = 0;
    std::vector<std::uint8_t> last_reply;
    AxisModel model{"x"};
    AxisLoop loop{model, {}};
    Bell bell{[] {}};

  private:
    bool asked_ = false;
    Time next_ = 1s;
    Time faces_due_{};
};

constexpr Reader kReaders[]{{mactalk::Kind::read, 0us},       {mactalk::Kind::read, 200us},
                            {mactalk::Kind::read, 4ms},       {mactalk::Kind::read, 12ms},
                            {mactalk::Kind::read_block, 0us}, {mactalk::Kind::read_block, 200us},
                            {mactalk::Kind::read_block, 30ms}};

std::string name_of(const Reader& client) {
    return (client.kind == mactalk::Kind::read ? "reads, " : "blocks, ") +
           std::to_string(client.gap.count() / 1'000) + " us between";
}

TEST(SharedMotor, CausesAreFoundBesideAClientThatKeepsReading) {
    for (const Reader& client : kReaders) {
        for (const bool runs : {false, true}) {
            SCOPED_TRACE(name_of(client) + (runs ? ", running" : ", stopped"));
            SharedMotor quiet(kQuietTable, runs, client);
            quiet.client_reads = false;
            const auto expected = quiet.causes(20s);
            ASSERT_NE(expected, nullptr);
            SharedMotor shared(kQuietTable, runs, client);
            const auto found = shared.causes(20s);
            ASSERT_NE(found, nullptr);
            EXPECT_EQ(found->front().code, expected->front().code);
            for (int i = 0; i < 60; ++i) EXPECT_NE(shared.causes(1s), nullptr) << "second " << i;
            EXPECT_EQ(shared.refusals, 0U);
        }
    }
}

/// As in a simulator on a machine that has little time for it: each answer is there long before it is taken.
TEST(SharedMotor, CausesAreFoundThoughTheFacesAreServedSeldom) {
    SharedMotor seldom(kQuietTable, true, {});
    seldom.client_reads = false;
    seldom.faces_every = 1'100ms;
    bool is_surveyed = false;
    for (int i = 0; i < 3'000 && !is_surveyed; ++i) {
        seldom.run(100ms);
        static_cast<void>(seldom.model.image_with_why(seldom.world.instant()));
        is_surveyed = seldom.model.survey_shelf().last().taken != base::Instant{};
    }
    EXPECT_TRUE(is_surveyed);
}

/// While the causes are sought, and for as long again.
TEST(SharedMotor, TheClientKeepsMostOfTheLine) {
    for (const Reader& client : kReaders) {
        for (const bool runs : {false, true}) {
            SCOPED_TRACE(name_of(client) + (runs ? ", running" : ", stopped"));
            SharedMotor alone(kQuietTable, runs, client);
            alone.has_faces = false;
            alone.run(11s);
            SharedMotor shared(kQuietTable, runs, client);
            for (int i = 0; i < 110; ++i) {
                shared.run(100ms);
                std::shared_ptr<const Findings> found;
                static_cast<void>(shared.model.image_with_why(shared.world.instant(), &found));
            }
            EXPECT_GE(4 * shared.answers, 3 * alone.answers);
            EXPECT_EQ(shared.last_reply, alone.last_reply) << "the answer is the client's own";
        }
    }
}

TEST(SharedMotor, OrdersComeAsOftenBesideAClientAndFaces) {
    const auto orders = [](bool has_faces, const Reader& client) {
        SharedMotor shared(kBusyTable, true, client);
        shared.has_faces = has_faces;
        for (int i = 0; i < 110; ++i) {
            shared.run(100ms);
            std::shared_ptr<const Findings> found;
            static_cast<void>(shared.model.image_with_why(shared.world.instant(), &found));
        }
        return shared.world.driver().counters().orders;
    };
    for (const Reader& client : kReaders) {
        SCOPED_TRACE(name_of(client));
        const std::uint32_t alone = orders(false, client);
        ASSERT_GT(alone, 300U);
        EXPECT_GE(10 * orders(true, client), 9 * alone);
    }
}

TEST(SharedMotor, AFacesErrorResetIsCarriedOutBesideAClient) {
    for (const Reader& client : kReaders) {
        SCOPED_TRACE(name_of(client));
        SharedMotor shared(kQuietTable, false, client);
        shared.run(3s);
        const auto plc = shared.model.join(Side::plant, "PLC", shared.bell);
        for (int turn = 0; turn < 20; ++turn) {
            shared.run(7ms);
            static_cast<void>(plc->submit(Command::reset_error(shared.world.instant())));
            std::optional<Completion> ended;
            for (int i = 0; i < 200 && !ended; ++i) {
                shared.run(10ms);
                ended = plc->take();
            }
            ASSERT_TRUE(ended);
            EXPECT_EQ(ended->result, Result::done) << turn;
        }
    }
}

}  // namespace
}  // namespace nplc::faces
