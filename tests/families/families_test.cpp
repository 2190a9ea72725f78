// A third family of drives, joined as any other: its name in a list and a file for each part.

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "gateway/controller.h"
#include "motor/any_driver.h"
#include "motor/step_driver.h"
#include "seqc/seqc.h"
#include "sim/world.h"

namespace nplc {
namespace {

using namespace std::chrono_literals;

constexpr std::string_view kThereAndBack = R"(PROGRAM P
MOTOR STEP1;
VAR_MOTOR Far AT P1 := 4096; Home AT P2 := 0; END_VAR
POWER_UP NEXT := Away; END_POWER_UP
STEP Away: OWN ERROR; ENTRY POSITION(Far); IF INPOS THEN NEXT := Back; END_IF END_STEP
STEP Back: OWN ERROR; ENTRY POSITION(Home); IF INPOS THEN NEXT := Done; END_IF END_STEP
STEP Done: OWN ERROR; IF IN0 THEN NEXT := Away; END_IF END_STEP
END_PROGRAM
)";

const registers::DriveModel& step1() {
    return *registers::find_drive("STEP1");
}

std::string told_of(const std::string& statement) {
    std::string source(kThereAndBack);
    source.insert(source.find("IF IN0 THEN NEXT") + 12, statement + " ");
    std::string text;
    for (const auto& d : seqc::compile(source).diagnostics)
        text += d.code + ": " + d.message + "; " + d.help + "\n";
    return text;
}

TEST(Families, AreListedByName) {
    ASSERT_EQ(registers::families().size(), 3U);
    EXPECT_EQ(registers::families()[0]->name(), "JVL");
    EXPECT_EQ(registers::families()[2]->name(), "ASCII");
    EXPECT_EQ(registers::find_drive_of_program("step1"), &step1());
    EXPECT_EQ(registers::drive_of_kind(4), &step1());
    EXPECT_EQ(registers::drive_of_kind(5), nullptr);
}

TEST(Families, ACompilerKnowsWhatTheNewOneCannotDo) {
    const auto good = seqc::compile(std::string(kThereAndBack));
    ASSERT_TRUE(good.ok) << (good.diagnostics.empty() ? "" : good.diagnostics[0].message);
    EXPECT_EQ(good.symbols.drive, &step1());
    EXPECT_NE(
        told_of("V_SOLL := 100;").find("E044: a STEP1 has no V_SOLL; a STEP1 has no registers but P1 to P8"),
        std::string::npos)
        << told_of("V_SOLL := 100;");
    EXPECT_NE(told_of("HOME;").find("a STEP1 only stops, goes to P1 to P8, and resets its error"),
              std::string::npos)
        << told_of("HOME;");
}

TEST(Families, ItsDriverIsMadeByItsKind) {
    struct Port final : ports::SerialPort {
        std::size_t write(std::span<const std::uint8_t> bytes) override {
            sent.append(bytes.begin(), bytes.end());
            return bytes.size();
        }
        std::size_t read(std::span<ports::ReceivedByte>) override { return 0; }
        bool transmitter_idle() override { return true; }
        std::string sent;
    } port;
    motor::AnyDriver driver;
    motor::Motor& motor = driver.start({.serial = &port}, {.motor_kind = step1().motor_kind});
    ASSERT_NE(driver.get<motor::step::StepMotor>(), nullptr);
    EXPECT_EQ(driver.get<motor::MidiMotor>(), nullptr);
    motor.poll(base::Instant{});
    EXPECT_EQ(port.sent, "?\n");
    driver.start({.serial = &port}, {});
    EXPECT_NE(driver.get<motor::JvlMotor>(), nullptr);
}

/// Controller, driver, line and virtual drive.
TEST(Families, AControllerRunsASequenceOnTheVirtualDrive) {
    sim::WorldOptions options;
    options.drive = {.model = &step1()};
    sim::World world(seqc::compile(std::string(kThereAndBack)).table, options);
    ASSERT_TRUE(world.load_result().ok);
    std::vector<std::int32_t> ends;
    std::uint8_t step = 0;
    while (world.now() < 5s) {
        world.step(world.now() + 10ms);
        const sim::Snapshot seen = world.take_snapshot();
        if (seen.step != step) ends.push_back(seen.p_ist);
        step = seen.step;
    }
    EXPECT_EQ(ends, (std::vector<std::int32_t>{0, 4096, 0}));
    EXPECT_EQ(world.driver().counters().discarded, 0U);
    EXPECT_FALSE(world.driver().error());
}

TEST(Families, ALostLinkIsAnErrorUntilItIsReset) {
    sim::WorldOptions options;
    options.drive = {.model = &step1()};
    sim::World world(seqc::compile(std::string(kThereAndBack)).table, options);
    const auto pass = [&world](sim::Time time) {
        for (const sim::Time end = world.now() + time; world.now() < end;) world.step(end);
    };
    pass(500ms);
    EXPECT_FALSE(world.driver().error());
    world.cut_line(true);
    pass(500ms);
    EXPECT_EQ(world.driver().link(), motor::Link::down);
    EXPECT_TRUE(world.driver().error());
}

TEST(Families, ATableThatItCannotDoIsRefusedWithItsReason) {
    sim::WorldOptions options;
    options.drive = {.model = &step1()};
    // Step 0: HOME (70h) at once; end.
    const std::vector<std::uint8_t> table{0xC0, 0x00, 0x00, 0x01, 0x70, 0x00, 0, 0,
                                          0x3F, 0,    0,    0,    0,    0,    0, 0};
    const sim::World world(table, options);
    EXPECT_EQ(world.load_result().fault.error, base::Error::not_for_motor);
    EXPECT_EQ(world.why_not(), step1().family->refuses_command(step1(), 0x70));
}

}  // namespace
}  // namespace nplc
