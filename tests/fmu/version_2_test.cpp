#include <gtest/gtest.h>

#include <cstdarg>
#include <cstdio>

#include "driver.h"

/// The same library spoken to in FMI 2.0.
namespace nplc::sim::fmu {
namespace {

void collect(fmi2ComponentEnvironment environment, fmi2String, fmi2Status, fmi2String, fmi2String format,
             ...) {
    char text[500];
    va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    static_cast<std::vector<std::string>*>(environment)->emplace_back(text);
}

class Fmu2 : public ::testing::Test {
  protected:
    static FmuOptions options() {
        FmuOptions options = options_of("pick_and_place.seq");
        options.fmi = 2;
        return options;
    }

    fmi2Component instantiate(const std::string& guid, const std::string& resources) {
        return NPLC_CALL(fmu_, fmi2Instantiate)("two", fmi2CoSimulation, guid.c_str(), resources.c_str(),
                                                &callbacks_, 0, 1);
    }
    std::string uri() const { return "file://" + fmu_.folder() + "/resour%63es"; }
    std::string last_message() const { return messages_.empty() ? "" : messages_.back(); }

    UnpackedFmu fmu_{packed(options())};
    std::vector<std::string> messages_;
    fmi2CallbackFunctions callbacks_{collect, nullptr, nullptr, nullptr, &messages_};
};

TEST_F(Fmu2, GoesTheSameCourseAsFmi3) {
    const UnpackedFmu in_3(packed(options_of("pick_and_place.seq")));
    Fmu3 three(in_3);
    three.start();
    EXPECT_STREQ(NPLC_CALL(fmu_, fmi2GetVersion)(), "2.0");
    EXPECT_STREQ(NPLC_CALL(fmu_, fmi2GetTypesPlatform)(), "default");
    const fmi2Component two = instantiate(fmu_.token(), uri());
    ASSERT_NE(two, nullptr) << last_message();
    ASSERT_EQ(NPLC_CALL(fmu_, fmi2SetupExperiment)(two, 0, 0, 0, 0, 0), fmi2OK);
    ASSERT_EQ(NPLC_CALL(fmu_, fmi2EnterInitializationMode)(two), fmi2OK);
    ASSERT_EQ(NPLC_CALL(fmu_, fmi2ExitInitializationMode)(two), fmi2OK);
    for (int ms = 0; ms < 1000; ++ms) {
        if (ms == 200 || ms == 250) {
            const fmi2ValueReference in0 = 1;
            const fmi2Boolean on = ms == 200 ? 1 : 0;
            ASSERT_EQ(NPLC_CALL(fmu_, fmi2SetBoolean)(two, &in0, 1, &on), fmi2OK);
            ASSERT_EQ(three.set(Id::in0, on != 0), fmi3OK);
        }
        ASSERT_EQ(NPLC_CALL(fmu_, fmi2DoStep)(two, three.time(), 1e-3, 1), fmi2OK) << last_message();
        ASSERT_EQ(three.step(1e-3), fmi3OK);
        const fmi2ValueReference reals[] = {0, 40, 41, 42};
        double values[4];
        ASSERT_EQ(NPLC_CALL(fmu_, fmi2GetReal)(two, reals, 4, values), fmi2OK);
        ASSERT_EQ(values[0], three.real(Id::time));
        ASSERT_EQ(values[1], three.real(Id::position)) << ms;
        ASSERT_EQ(values[2], three.real(Id::velocity)) << ms;
        ASSERT_EQ(values[3], three.real(Id::torque)) << ms;
        const fmi2ValueReference integers[] = {43, 45, 54};
        int numbers[3];
        ASSERT_EQ(NPLC_CALL(fmu_, fmi2GetInteger)(two, integers, 3, numbers), fmi2OK) << last_message();
        ASSERT_EQ(numbers[0], three.integer(Id::p_ist));
        ASSERT_EQ(static_cast<std::uint32_t>(numbers[1]), three.bits(Id::err_stat));
        ASSERT_EQ(numbers[2], three.integer(Id::step));
    }
    EXPECT_GT(three.integer(Id::p_ist), 1000);
    double reached = 0;
    EXPECT_EQ(NPLC_CALL(fmu_, fmi2GetRealStatus)(two, fmi2LastSuccessfulTime, &reached), fmi2OK);
    EXPECT_EQ(reached, three.time());
    fmi2FMUstate state = nullptr;
    EXPECT_EQ(NPLC_CALL(fmu_, fmi2GetFMUstate)(two, &state), fmi2OK);
    EXPECT_EQ(NPLC_CALL(fmu_, fmi2SetFMUstate)(two, state), fmi2OK);
    EXPECT_EQ(NPLC_CALL(fmu_, fmi2FreeFMUstate)(two, &state), fmi2OK);
    EXPECT_EQ(NPLC_CALL(fmu_, fmi2Terminate)(two), fmi2OK);
    NPLC_CALL(fmu_, fmi2FreeInstance)(two);
}

TEST_F(Fmu2, RefusesWhatIsWrong) {
    EXPECT_EQ(instantiate("{no}", uri()), nullptr);
    EXPECT_NE(last_message().find("GUID"), std::string::npos) << last_message();
    EXPECT_EQ(NPLC_CALL(fmu_, fmi2Instantiate)("x", fmi2ModelExchange, "", "", &callbacks_, 0, 0), nullptr);
    EXPECT_NE(last_message().find("co-simulation"), std::string::npos) << last_message();
    EXPECT_EQ(NPLC_CALL(fmu_, fmi2Instantiate)(nullptr, fmi2CoSimulation, nullptr, nullptr, nullptr, 0, 0),
              nullptr);
    const fmi2Component one = instantiate(fmu_.token(), fmu_.resources());
    ASSERT_NE(one, nullptr) << last_message();
    EXPECT_EQ(NPLC_CALL(fmu_, fmi2DoStep)(one, 0, 0.1, 1), fmi2Error);
    EXPECT_EQ(NPLC_CALL(fmu_, fmi2CancelStep)(one), fmi2Error);
    const fmi2ValueReference position = 40;
    int number = 0;
    EXPECT_EQ(NPLC_CALL(fmu_, fmi2GetInteger)(one, &position, 1, &number), fmi2Error);
    EXPECT_NE(last_message().find("position"), std::string::npos) << last_message();
    NPLC_CALL(fmu_, fmi2FreeInstance)(one);
}

}  // namespace
}  // namespace nplc::sim::fmu
