#include "faces/upload.h"

#include <gtest/gtest.h>

#include "registers/gateway.h"

namespace nplc::faces {
namespace {

namespace own = registers::gateway;

constexpr base::Instant kUploadStart{base::Milliseconds{100}};

/// A gateway that stores whatever comes.
class UploadBench {
  public:
    explicit UploadBench(std::size_t bytes, Upload::Afterwards wish)
        : upload(std::vector<std::uint8_t>(bytes, 7), wish, 1) {}

    /// The next command, which then ends with `result`.
    std::optional<Command> step(Result result = Result::done) {
        ++image.number;
        const auto command = upload.next(image, now);
        if (command) upload.ended({.id = 1, .result = result}, now);
        return command;
    }
    void stored(own::StorePhase phase, Result result = Result::done) {
        image.own[own::UPLOAD_STATE] = static_cast<std::uint32_t>(phase) | static_cast<std::uint32_t>(result)
                                                                               << 8;
    }

    Upload upload;
    AxisImage image{};
    base::Instant now = kUploadStart;
};

void send_all(UploadBench& bench, std::size_t pieces) {
    EXPECT_EQ(bench.step()->value, static_cast<std::uint32_t>(own::Command::upload_begin));
    for (std::size_t i = 0; i < pieces; ++i) EXPECT_EQ(bench.step()->reg, own::TABLE_DATA);
    EXPECT_EQ(bench.step()->reg, own::UPLOAD_BYTES);
    EXPECT_EQ(bench.step()->reg, own::UPLOAD_CRC);
    EXPECT_EQ(bench.step()->value, static_cast<std::uint32_t>(own::Command::upload_commit));
}

TEST(PanelUpload, StoresInPieces) {
    UploadBench bench(300, {});  // 128 + 128 + 44
    send_all(bench, 3);
    EXPECT_EQ(bench.upload.sent(), 300U);
    bench.stored(own::StorePhase::closing);
    EXPECT_FALSE(bench.step().has_value());
    bench.stored(own::StorePhase::done);
    EXPECT_FALSE(bench.step().has_value());
    EXPECT_TRUE(bench.upload.is_over());
    EXPECT_EQ(bench.upload.result(), Result::done);
}

TEST(PanelUpload, StopsBeforeItMakesActive) {
    UploadBench bench(16, {.activate = true, .run = true});
    send_all(bench, 1);
    bench.step();  // an image of before the commit may still show "stored" for the upload before
    bench.stored(own::StorePhase::done);
    EXPECT_EQ(bench.step()->value, static_cast<std::uint32_t>(own::Command::stop));
    EXPECT_EQ(bench.step(Result::moving)->value, static_cast<std::uint32_t>(own::Command::activate));
    EXPECT_FALSE(bench.upload.is_over());
    bench.now += base::Milliseconds{20};
    EXPECT_EQ(bench.step()->value, static_cast<std::uint32_t>(own::Command::activate));
    EXPECT_EQ(bench.step()->value, static_cast<std::uint32_t>(own::Command::run));
    EXPECT_TRUE(bench.upload.is_over());
    EXPECT_EQ(bench.upload.result(), Result::done);
}

TEST(PanelUpload, EndsIfSomebodyGivesItUpWhileItIsStored) {
    UploadBench bench(16, {.activate = true});
    send_all(bench, 1);
    bench.stored(own::StorePhase::closing);
    bench.step();
    bench.step();
    EXPECT_FALSE(bench.upload.is_over());
    bench.stored(own::StorePhase::idle);
    bench.step();
    EXPECT_TRUE(bench.upload.is_over());
    EXPECT_EQ(bench.upload.result(), Result::too_late);
    EXPECT_EQ(bench.upload.stage_in_words(), "storing the table");
}

TEST(PanelUpload, SaysWhereItFailed) {
    UploadBench bench(16, {.activate = true});
    send_all(bench, 1);
    bench.step();
    bench.stored(own::StorePhase::failed, Result::bad_next_step);
    bench.step();
    EXPECT_TRUE(bench.upload.is_over());
    EXPECT_EQ(bench.upload.result(), Result::bad_next_step);
    EXPECT_EQ(bench.upload.stage_in_words(), "storing the table");
}

TEST(PanelUpload, AnotherClientsSeatEndsIt) {
    UploadBench bench(16, {});
    bench.step(Result::seat_taken);
    EXPECT_TRUE(bench.upload.is_over());
    EXPECT_EQ(bench.upload.result(), Result::seat_taken);
    EXPECT_EQ(bench.upload.stage_in_words(), "sending the table");
}

TEST(PanelUpload, AStoreThatStaysBusyEndsIt) {
    UploadBench bench(16, {});
    EXPECT_TRUE(bench.step(Result::busy).has_value());
    EXPECT_FALSE(bench.step().has_value()) << "not at once again";
    bench.now += base::Milliseconds{10'020};
    EXPECT_TRUE(bench.step(Result::busy).has_value());
    EXPECT_TRUE(bench.upload.is_over());
    EXPECT_EQ(bench.upload.result(), Result::busy);
}

}  // namespace
}  // namespace nplc::faces
