#include "hal_linux/gpio.h"

#include <filesystem>

#include "outside.h"

// The lines of the virtual board: 0 IN_START, 1 IN_PART, 4 OUT_GRIP, 5 OUT_LAMP, 6 and 7 both TWICE.
namespace nplc::board_tests {
namespace {

using hal_linux::GpioBias;
using hal_linux::GpioBits;
using hal_linux::GpioInputs;
using hal_linux::GpioLine;
using hal_linux::GpioOutputs;

using Lines = std::vector<std::optional<GpioLine>>;

std::string take_inputs(GpioBits& bits, const Lines& lines) {
    return bits.take({.lines = lines, .consumer = "nanoplc"});
}
std::string take_outputs(GpioBits& bits, const Lines& lines, std::uint8_t first) {
    return bits.take({.lines = lines, .consumer = "nanoplc", .outputs = first});
}
std::string refusal(const Lines& lines) {
    GpioBits bits;
    return take_inputs(bits, lines);
}

/// The line of gpioinfo on this one.
std::string info(unsigned line) {
    return output_of("gpioinfo gpiochip0 | grep 'line *" + std::to_string(line) + ":'");
}
bool tells(const std::string& text, const std::string& words) {
    return text.find(words) != std::string::npos;
}

class Gpio : public testing::Test {
  protected:
    void TearDown() override {
        for (unsigned line = 0; line < 8; ++line) outside_.drive(line, false);
    }
    Outside outside_;
};

TEST_F(Gpio, InputsAreReadByNameAndByNumber) {
    GpioBits bits;
    const Lines lines{GpioLine{"IN_START"}, std::nullopt, GpioLine{"gpiochip0:2"},
                      GpioLine{"/dev/gpiochip0:3"}};
    ASSERT_EQ(take_inputs(bits, lines), "");
    GpioInputs inputs(bits);
    for (const unsigned levels : {0U, 1U, 4U, 8U, 13U, 5U, 0U}) {
        for (const unsigned line : {0U, 2U, 3U}) outside_.drive(line, ((levels >> line) & 1U) != 0);
        inputs.look();
        EXPECT_EQ(inputs.read(), levels);
    }
    outside_.drive(1, true);
    inputs.look();
    EXPECT_EQ(inputs.read(), 0) << "line 1 is nobody's";
    EXPECT_FALSE(inputs.lost());
}

TEST_F(Gpio, WhoHoldsALineIsSeenByOthers) {
    GpioBits bits;
    const Lines lines{GpioLine{"gpiochip0:2", true, GpioBias::pull_up},
                      GpioLine{"gpiochip0:3", false, GpioBias::off}};
    ASSERT_EQ(take_inputs(bits, lines), "");
    EXPECT_TRUE(tells(info(2), "\"nanoplc\"   input   active-low [used pull-up]")) << info(2);
    EXPECT_TRUE(tells(info(3), "\"nanoplc\"   input  active-high [used bias-disabled]")) << info(3);
    EXPECT_TRUE(tells(info(1), "unused   input  active-high")) << info(1);
    EXPECT_TRUE(tells(output_of("gpioget gpiochip0 2"), "Device or resource busy"));
}

TEST_F(Gpio, AnActiveLowInputIsTurnedRound) {
    GpioBits bits;
    const Lines lines{GpioLine{"IN_START"}, GpioLine{"IN_PART", true}};
    ASSERT_EQ(take_inputs(bits, lines), "");
    EXPECT_EQ(bits.levels(), 0b10);
    outside_.drive(1, true);
    EXPECT_EQ(bits.levels(), 0b00);
    outside_.drive(0, true);
    EXPECT_EQ(bits.levels(), 0b01);
}

/// The descriptors that are readable, each taken.
bool take_edges(const GpioBits& bits, GpioInputs& inputs, int milliseconds) {
    std::vector<pollfd> all;
    for (const int descriptor : bits.descriptors()) all.push_back({descriptor, POLLIN, 0});
    if (::poll(all.data(), all.size(), milliseconds) <= 0) return false;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (all[i].revents != 0) inputs.look_at(i);
    }
    return true;
}

TEST_F(Gpio, AnEdgeWakesWhoWaitsAndTellsTheLevel) {
    GpioBits bits;
    const Lines lines{GpioLine{"IN_START"}, std::nullopt, GpioLine{"IN_PART", true}, GpioLine{"gpiochip0:2"}};
    ASSERT_EQ(take_inputs(bits, lines), "");
    GpioInputs inputs(bits);
    while (take_edges(bits, inputs, 0)) continue;  // the chip may have kept one of before
    const std::array<unsigned, 3> bit{0, 2, 3};
    for (const unsigned line : {0U, 1U, 2U}) {
        for (const bool level : {true, false}) {
            EXPECT_FALSE(take_edges(bits, inputs, 0));
            outside_.drive(line, level);
            EXPECT_TRUE(take_edges(bits, inputs, kSoon)) << line;
            EXPECT_EQ(inputs.read(), 0b100U ^ (level ? 1U << bit[line] : 0U)) << "IN_PART is active low";
        }
    }
}

TEST_F(Gpio, MoreEdgesThanTheKernelKeepsLeaveTheTrueLevel) {
    GpioBits bits;
    const Lines lines{GpioLine{"IN_START"}};
    ASSERT_EQ(take_inputs(bits, lines), "");
    GpioInputs inputs(bits);
    for (const bool last : {true, false}) {
        for (int i = 0; i < 50; ++i) {
            outside_.drive(0, !last);
            outside_.drive(0, last);
        }
        EXPECT_TRUE(take_edges(bits, inputs, kSoon));
        while (take_edges(bits, inputs, 0)) continue;
        EXPECT_EQ(inputs.read(), last ? 1 : 0);
    }
}

TEST_F(Gpio, OutputsHaveTheirFirstLevelFromTheStartAndTheSafeOneAtTheEnd) {
    {
        GpioBits bits;
        const Lines lines{GpioLine{"OUT_GRIP"}, GpioLine{"OUT_LAMP"}};
        ASSERT_EQ(take_outputs(bits, lines, 0b10), "");
        EXPECT_FALSE(outside_.level(4));
        EXPECT_TRUE(outside_.level(5));
        EXPECT_TRUE(tells(info(5), "\"nanoplc\"  output  active-high [used]")) << info(5);
        GpioOutputs outputs(bits, 0b01);
        outputs.write(0b11);
        EXPECT_TRUE(outside_.level(4) && outside_.level(5));
        outputs.write(0b00);
        EXPECT_FALSE(outside_.level(4) || outside_.level(5));
        outputs.write(0b10);
        EXPECT_FALSE(outputs.lost());
    }
    EXPECT_TRUE(outside_.level(4));
    EXPECT_FALSE(outside_.level(5));
    EXPECT_TRUE(tells(info(4), "unused")) << info(4);
}

TEST_F(Gpio, AnActiveLowOutputIsTurnedRound) {
    GpioBits bits;
    const Lines lines{GpioLine{"OUT_GRIP", true}};
    ASSERT_EQ(take_outputs(bits, lines, 0), "");
    EXPECT_TRUE(outside_.level(4));
    bits.set(1);
    EXPECT_FALSE(outside_.level(4));
}

TEST_F(Gpio, AfterACrashTheLineIsFreeAndThisChipHoldsItsLevel) {
    std::array<int, 2> ready{};
    ASSERT_EQ(::pipe(ready.data()), 0);
    Process process([&] {
        GpioBits bits;
        const Lines lines{GpioLine{"OUT_GRIP"}};
        const bool taken = take_outputs(bits, lines, 1).empty();
        if (::write(ready[1], taken ? "1" : "0", 1) == 1) ::pause();
        return 0;
    });
    ASSERT_TRUE(readable(ready[0], kSoon));
    EXPECT_TRUE(tells(info(4), "nanoplc"));
    process.kill();
    EXPECT_TRUE(tells(info(4), "unused")) << info(4);
    EXPECT_TRUE(outside_.level(4)) << "the driver of a PL061 leaves a free line as it is";
    GpioBits bits;
    const Lines lines{GpioLine{"OUT_GRIP"}};
    EXPECT_EQ(take_outputs(bits, lines, 0), "") << "the next start has it, and its safe level";
    EXPECT_FALSE(outside_.level(4));
}

TEST_F(Gpio, ALineInUseIsRefusedWithTheNameOfItsHolder) {
    run("gpioset --mode=signal --background gpiochip0 4=1");
    GpioBits bits;
    const Lines lines{GpioLine{"OUT_LAMP"}, GpioLine{"OUT_GRIP"}};
    EXPECT_EQ(take_outputs(bits, lines, 0),
              "/dev/gpiochip0:4 is in use by 'gpioset'; end that program, or free the line of that driver");
    EXPECT_TRUE(tells(info(5), "unused")) << "none is held when one is not to be had: " << info(5);
    run("killall gpioset");
    while (tells(info(4), "gpioset")) continue;
    EXPECT_EQ(take_outputs(bits, lines, 0), "");
}

TEST_F(Gpio, ALineOfAKernelDriverIsRefusedWithItsName) {
    run("modprobe gpio_keys");
    EXPECT_EQ(refusal({GpioLine{"gpiochip0:3"}}),
              "/dev/gpiochip0:3 is in use by 'GPIO Key Poweroff'; end that program, or free the line of that "
              "driver");
    run("rmmod gpio_keys");
    EXPECT_EQ(refusal({GpioLine{"gpiochip0:3"}}), "");
}

TEST_F(Gpio, SaysWhatIsWrong) {
    EXPECT_EQ(hal_linux::find_line("OUT_GRIP").place, "/dev/gpiochip0:4");
    EXPECT_EQ(hal_linux::find_line("gpiochip0:4").place, "/dev/gpiochip0:4");
    EXPECT_EQ(hal_linux::find_line("gpiochip7:0").problem,
              "there is no /dev/gpiochip7; `gpiodetect` lists the chips");
    EXPECT_EQ(refusal({GpioLine{"gpiochip7:0"}}), "there is no /dev/gpiochip7; `gpiodetect` lists the chips");
    EXPECT_EQ(refusal({GpioLine{"gpiochip0:8"}}), "/dev/gpiochip0 has the lines 0 to 7, not 8");
    EXPECT_EQ(refusal({GpioLine{"IN_STOP"}}),
              "no chip has a line of the name 'IN_STOP'; `gpioinfo` lists them, or write gpiochip0:17");
    EXPECT_EQ(refusal({GpioLine{"TWICE"}}),
              "more than one line has the name 'TWICE': /dev/gpiochip0:6 and /dev/gpiochip0:7; write one of "
              "these instead");
    EXPECT_EQ(refusal({GpioLine{""}}), "no line is named; write gpiochip0:17 or a line's name");
    EXPECT_EQ(refusal({GpioLine{"/dev/null:0"}}), "/dev/null is not a GPIO chip");
    EXPECT_EQ(refusal({GpioLine{"IN_START"}, GpioLine{"gpiochip0:0"}}), "gpiochip0:0 is named twice");
    EXPECT_EQ(refusal(Lines(9)), "at most 8 lines can be had at once");
    const std::string forbidden = "you may not use /dev/gpiochip0; join the group that may (often gpio)";
    EXPECT_EQ(as_nobody([] { return refusal({GpioLine{"gpiochip0:0"}}); }), forbidden);
    EXPECT_EQ(as_nobody([] { return refusal({GpioLine{"IN_START"}}); }), forbidden);
}

TEST_F(Gpio, ALinkToAChipIsThatChip) {
    std::filesystem::create_symlink("gpiochip0", "/dev/gpiochip4");
    EXPECT_EQ(refusal({GpioLine{"gpiochip4:2"}, GpioLine{"gpiochip0:2"}}), "gpiochip0:2 is named twice");
    EXPECT_EQ(refusal({GpioLine{"IN_START"}}), "") << "it is found once";
    std::filesystem::remove("/dev/gpiochip4");
}

// The last, for the kernel gives the chip another number then.
class GpioGone : public Gpio {};

TEST_F(GpioGone, AChipThatIsTakenAwayReadsZeroAndIsLost) {
    {
        GpioBits bits;
        GpioBits driven;
        ASSERT_EQ(take_inputs(bits, {GpioLine{"IN_START", true}}), "");
        ASSERT_EQ(take_outputs(driven, {GpioLine{"OUT_GRIP"}}, 0), "");
        GpioInputs inputs(bits);
        GpioOutputs outputs(driven, 0);
        EXPECT_EQ(inputs.read(), 1);
        run("echo 9030000.pl061 > /sys/bus/amba/drivers/pl061_gpio/unbind");
        inputs.look();
        EXPECT_EQ(inputs.read(), 0);
        EXPECT_TRUE(inputs.lost());
        outputs.write(1);
        EXPECT_TRUE(outputs.lost());
    }
    EXPECT_EQ(refusal({GpioLine{"IN_START"}}),
              "no chip has a line of the name 'IN_START'; `gpioinfo` lists them, or write gpiochip0:17");
    run("echo 9030000.pl061 > /sys/bus/amba/drivers/pl061_gpio/bind");
    EXPECT_EQ(refusal({GpioLine{"IN_START"}}), "");
}

}  // namespace
}  // namespace nplc::board_tests
