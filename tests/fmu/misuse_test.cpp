#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "driver.h"

/// What the standard forbids is answered with fmi3Error and a reason, changes nothing, and never ends the
/// process.
namespace nplc::sim::fmu {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

class FmuMisuse : public ::testing::Test {
  protected:
    void refused(const Fmu3& one, fmi3Status status, const std::string& says) {
        EXPECT_EQ(status, fmi3Error);
        EXPECT_NE(one.last_message().find(says), std::string::npos) << one.last_message();
    }

    UnpackedFmu fmu_{packed(options_of("pick_and_place.seq"))};
};

TEST_F(FmuMisuse, WrongTokenOrResources) {
    const Fmu3 wrong(fmu_, "{8c4e810f-3df3-4a00-8276-176fa3c9f003}");
    EXPECT_EQ(wrong.instance(), nullptr);
    EXPECT_NE(wrong.last_message().find("token"), std::string::npos) << wrong.last_message();
    const Fmu3 nowhere(fmu_, nullptr, "/no/such/folder/");
    EXPECT_EQ(nowhere.instance(), nullptr);
    EXPECT_NE(nowhere.last_message().find("/no/such/folder/machine.txt"), std::string::npos)
        << nowhere.last_message();
    const UnpackedFmu other(packed(options_of("")));
    const std::string others = other.resources();
    const Fmu3 mixed(fmu_, nullptr, others.c_str());
    EXPECT_EQ(mixed.instance(), nullptr);
    EXPECT_NE(mixed.last_message().find("token"), std::string::npos) << mixed.last_message();
}

TEST_F(FmuMisuse, DamagedResources) {
    const auto damage = [this](std::string_view file, const std::string& content) {
        std::FILE* stream = std::fopen((fmu_.resources() + std::string(file)).c_str(), "wb");
        ASSERT_NE(stream, nullptr);
        std::fwrite(content.data(), 1, content.size(), stream);
        std::fclose(stream);
    };
    const std::string machine = fmu_.files().at("resources/machine.txt");
    for (const std::string& text :
         {std::string(), std::string("nanoplc-fmu 2\n"), machine + "more\n",
          machine.substr(0, machine.size() - 1), std::string("nanoplc-fmu 1\nmotor MAC9\n")}) {
        damage("machine.txt", text);
        const Fmu3 one(fmu_);
        EXPECT_EQ(one.instance(), nullptr) << text;
        EXPECT_NE(one.last_message().find("machine.txt"), std::string::npos) << one.last_message();
    }
    damage("machine.txt", machine);
    damage("table.bin", "no table");
    const Fmu3 one(fmu_);
    EXPECT_EQ(one.instance(), nullptr);
    EXPECT_NE(one.last_message().find("table.bin: is damaged"), std::string::npos) << one.last_message();
}

TEST_F(FmuMisuse, WithoutALoggerNothingIsSaidAndNothingBreaks) {
    const std::string resources = fmu_.resources();
    EXPECT_EQ(NPLC_CALL(fmu_, fmi3InstantiateCoSimulation)("x", nullptr, nullptr, false, false, false, false,
                                                           nullptr, 0, nullptr, nullptr, nullptr),
              nullptr);
    const std::string token = fmu_.token();
    const fmi3Instance one =
        NPLC_CALL(fmu_, fmi3InstantiateCoSimulation)(nullptr, token.c_str(), resources.c_str(), true, false,
                                                     true, true, nullptr, 0, nullptr, nullptr, nullptr);
    ASSERT_NE(one, nullptr);
    EXPECT_EQ(NPLC_CALL(fmu_, fmi3Terminate)(one), fmi3Error);
    NPLC_CALL(fmu_, fmi3FreeInstance)(one);
}

TEST_F(FmuMisuse, OtherInterfaces) {
    std::vector<std::string> messages;
    const auto log = [](fmi3InstanceEnvironment environment, fmi3Status, fmi3String, fmi3String message) {
        static_cast<std::vector<std::string>*>(environment)->emplace_back(message);
    };
    EXPECT_EQ(NPLC_CALL(fmu_, fmi3InstantiateModelExchange)("x", "", "", false, false, &messages, log),
              nullptr);
    EXPECT_EQ(NPLC_CALL(fmu_, fmi3InstantiateScheduledExecution)("x", "", "", false, false, &messages, log,
                                                                 nullptr, nullptr, nullptr),
              nullptr);
    ASSERT_EQ(messages.size(), 2U);
    EXPECT_NE(messages[0].find("co-simulation"), std::string::npos);
}

TEST_F(FmuMisuse, CallsOutOfOrder) {
    Fmu3 one(fmu_);
    refused(one, one.step(1e-3), "only when the instance is in step mode, and it is just instantiated");
    refused(one, NPLC_CALL(fmu_, fmi3ExitInitializationMode)(one.instance()), "leaving initialization mode");
    refused(one, NPLC_CALL(fmu_, fmi3Terminate)(one.instance()), "terminating");
    refused(one, NPLC_CALL(fmu_, fmi3EnterEventMode)(one.instance()), "does not offer");
    refused(one, NPLC_CALL(fmu_, fmi3EnterStepMode)(one.instance()), "does not offer");
    one.start();
    refused(one, NPLC_CALL(fmu_, fmi3EnterInitializationMode)(one.instance(), false, 0, 0, false, 0),
            "it is in step mode");
    ASSERT_EQ(NPLC_CALL(fmu_, fmi3Terminate)(one.instance()), fmi3OK);
    refused(one, one.step(1e-3), "it is terminated");
    refused(one, one.set(Id::in0, true), "terminated");
    EXPECT_EQ(one.integer(Id::step), 0) << "what was reached can still be read";
    EXPECT_EQ(NPLC_CALL(fmu_, fmi3Reset)(one.instance()), fmi3OK);
    one.start();
    EXPECT_EQ(one.step(1e-3), fmi3OK);
}

TEST_F(FmuMisuse, TimesAndSteps) {
    Fmu3 one(fmu_);
    for (const double start : {kNaN, kInfinity, 1e300}) {
        refused(one, NPLC_CALL(fmu_, fmi3EnterInitializationMode)(one.instance(), false, 0, start, false, 0),
                "start time");
    }
    refused(one, NPLC_CALL(fmu_, fmi3EnterInitializationMode)(one.instance(), false, 0, 5, true, 4),
            "before the start");
    refused(one, NPLC_CALL(fmu_, fmi3EnterInitializationMode)(one.instance(), false, 0, 5, true, kNaN),
            "before the start");
    ASSERT_EQ(NPLC_CALL(fmu_, fmi3EnterInitializationMode)(one.instance(), false, 0, 0, true, 0.01), fmi3OK);
    ASSERT_EQ(NPLC_CALL(fmu_, fmi3ExitInitializationMode)(one.instance()), fmi3OK);
    refused(one, one.step(0), "longer than 0");
    refused(one, one.step(-1e-3), "longer than 0");
    for (const double size : {kNaN, kInfinity, -kInfinity}) refused(one, one.step(size), "must be numbers");
    refused(one, one.step(1e300), "stop time");
    double reached = -1;
    bool flag = false;
    refused(one, NPLC_CALL(fmu_, fmi3DoStep)(one.instance(), 0.5, 1e-3, true, &flag, &flag, &flag, &reached),
            "the last one ended at 0 s");
    EXPECT_EQ(reached, 0);
    refused(one,
            NPLC_CALL(fmu_, fmi3DoStep)(one.instance(), kNaN, 1e-3, true, nullptr, nullptr, nullptr, nullptr),
            "must be numbers");
    EXPECT_EQ(one.step(0.01), fmi3OK) << one.last_message();
    refused(one, one.step(0.01), "the stop time is 0.01 s");
    Fmu3 endless(fmu_);
    endless.start();
    refused(endless, endless.step(1e12), "a simulation lasts");
}

TEST_F(FmuMisuse, Variables) {
    Fmu3 one(fmu_);
    double number = 0;
    bool truth = false;
    const auto get = NPLC_CALL(fmu_, fmi3GetFloat64);
    for (const fmi3ValueReference unknown : {7U, 59U, 60U, 4'000'000'000U})
        refused(one, get(one.instance(), &unknown, 1, &number, 1), "no such variable");
    const fmi3ValueReference p_soll = 11;  // of the motor alone
    refused(one, get(one.instance(), &p_soll, 1, &number, 1), "no such variable");
    const fmi3ValueReference in0 = 1;
    refused(one, get(one.instance(), &in0, 1, &number, 1), "is a Boolean, not a Float64");
    refused(one, get(one.instance(), nullptr, 1, &number, 1), "null pointer");
    refused(one, get(one.instance(), &in0, 1, nullptr, 1), "null pointer");
    refused(one, NPLC_CALL(fmu_, fmi3GetBoolean)(one.instance(), &in0, 1, &truth, 2), "2 values");
    EXPECT_EQ(get(one.instance(), nullptr, 0, nullptr, 0), fmi3OK);
    refused(one, one.set(Id::position, 1.0), "no input and no parameter");
    refused(one, one.set(Id::time, 1.0), "no input and no parameter");
    refused(one, one.set(Id::load_torque, kNaN), "is no number");
    refused(one, one.set(Id::load_torque, kInfinity), "is no number");
    refused(one, one.set(Id::load_torque, 16.0), "beyond");
    refused(one, one.set(Id::load_inertia, -1e-6), "beyond");
    EXPECT_EQ(one.real(Id::load_torque), 0);
    const fmi3ValueReference both[] = {10, 21};
    const double values[] = {1.0, -1.0};
    refused(one, NPLC_CALL(fmu_, fmi3SetFloat64)(one.instance(), both, 2, values, 2), "friction_torque");
    EXPECT_EQ(one.real(Id::load_torque), 0) << "all are set, or none";
    fmi3String text = nullptr;
    refused(one, NPLC_CALL(fmu_, fmi3GetString)(one.instance(), &in0, 1, &text, 1), "of type String");
    float single = 0;
    refused(one, NPLC_CALL(fmu_, fmi3GetFloat32)(one.instance(), &in0, 1, &single, 1), "of type Float32");
}

TEST_F(FmuMisuse, RegistersBeyondTheirRange) {
    const UnpackedFmu fmu(packed(options_of("")));
    Fmu3 one(fmu);
    EXPECT_EQ(one.set(Id::v_soll, 32'767), fmi3OK);
    refused(one, one.set(Id::v_soll, 32'768), "V_SOLL cannot be set: 32768 is beyond -32767 to 32767");
    refused(one, one.set(Id::t_soll, -1), "beyond 0 to 1023");
    refused(one, one.set(Id::in0, true), "no such variable");
}

TEST_F(FmuMisuse, Logging) {
    Fmu3 one(fmu_);
    const fmi3String unknown[] = {"logEverything"};
    refused(one, NPLC_CALL(fmu_, fmi3SetDebugLogging)(one.instance(), true, 1, unknown), "logEverything");
    const fmi3String errors[] = {"logStatusError"};
    EXPECT_EQ(NPLC_CALL(fmu_, fmi3SetDebugLogging)(one.instance(), false, 1, errors), fmi3OK);
    const std::size_t said = one.messages.size();
    EXPECT_EQ(one.step(1), fmi3Error);
    EXPECT_EQ(one.messages.size(), said);
    EXPECT_EQ(NPLC_CALL(fmu_, fmi3SetDebugLogging)(one.instance(), true, 0, nullptr), fmi3OK);
    EXPECT_EQ(one.step(1), fmi3Error);
    EXPECT_EQ(one.messages.size(), said + 1);
}

TEST_F(FmuMisuse, InstancesThatAreNone) {
    int nothing = 0;
    for (void* instance : {static_cast<void*>(nullptr), static_cast<void*>(&nothing)}) {
        double value = 0;
        const fmi3ValueReference reference = 40;
        EXPECT_EQ(NPLC_CALL(fmu_, fmi3GetFloat64)(instance, &reference, 1, &value, 1), fmi3Error);
        EXPECT_EQ(NPLC_CALL(fmu_, fmi3DoStep)(instance, 0, 1, true, nullptr, nullptr, nullptr, nullptr),
                  fmi3Error);
        EXPECT_EQ(NPLC_CALL(fmu_, fmi3Reset)(instance), fmi3Error);
        NPLC_CALL(fmu_, fmi3FreeInstance)(instance);
    }
    const std::string token = fmu_.token();
    const std::string resources = fmu_.resources();
    const fmi3Instance freed =
        NPLC_CALL(fmu_, fmi3InstantiateCoSimulation)("x", token.c_str(), resources.c_str(), false, false,
                                                     false, false, nullptr, 0, nullptr, nullptr, nullptr);
    ASSERT_NE(freed, nullptr);
    NPLC_CALL(fmu_, fmi3FreeInstance)(freed);
    NPLC_CALL(fmu_, fmi3FreeInstance)(freed);
    EXPECT_EQ(NPLC_CALL(fmu_, fmi3Terminate)(freed), fmi3Error);
    fmi3FMUState state = &nothing;
    Fmu3 one(fmu_);
    refused(one, NPLC_CALL(fmu_, fmi3SetFMUState)(one.instance(), state), "not one of this instance");
    refused(one, NPLC_CALL(fmu_, fmi3SetFMUState)(one.instance(), nullptr), "not one of this instance");
    refused(one, NPLC_CALL(fmu_, fmi3FreeFMUState)(one.instance(), &state), "not one of this instance");
    refused(one, NPLC_CALL(fmu_, fmi3GetFMUState)(one.instance(), nullptr), "no place");
}

}  // namespace
}  // namespace nplc::sim::fmu
