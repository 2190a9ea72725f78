#include <gtest/gtest.h>

#include "driver.h"

/// A state that was kept is put back whole: all goes on from it as it did.
namespace nplc::sim::fmu {
namespace {

using Course = std::vector<std::map<std::string, double>>;

Course go_on(Fmu3& one, const std::vector<Variable>& variables, int steps) {
    Course course;
    for (int i = 0; i < steps; ++i) {
        EXPECT_EQ(one.step(2e-3), fmi3OK) << one.last_message();
        course.push_back(one.outputs(variables));
    }
    return course;
}

fmi3FMUState saved(const Fmu3& one) {
    fmi3FMUState state = nullptr;
    EXPECT_EQ(NPLC_CALL(one.fmu(), fmi3GetFMUState)(one.instance(), &state), fmi3OK) << one.last_message();
    return state;
}

TEST(FmuState, GoesOnAsItDid) {
    const FmuOptions options = options_of("pick_and_place.seq");
    const UnpackedFmu fmu(packed(options));
    const auto variables = variables_of(options.setup);
    Fmu3 one(fmu);
    one.start();
    go_on(one, variables, 100);
    ASSERT_EQ(one.set(Id::in0, true), fmi3OK);
    go_on(one, variables, 60);
    const double at = one.time();
    const fmi3FMUState state = saved(one);
    const Course first = go_on(one, variables, 400);
    const auto turn_back = [&](const Fmu3& instance) {
        ASSERT_EQ(NPLC_CALL(fmu, fmi3SetFMUState)(instance.instance(), state), fmi3OK) << one.last_message();
    };
    for (int round = 0; round < 3; ++round) {
        turn_back(one);
        double time = 0;
        const fmi3ValueReference reference = 0;
        ASSERT_EQ(NPLC_CALL(fmu, fmi3GetFloat64)(one.instance(), &reference, 1, &time, 1), fmi3OK);
        EXPECT_EQ(time, at);
        double reached = 0;
        bool flag = false;
        Course again;
        double now = at;
        for (std::size_t i = 0; i < first.size(); ++i) {
            ASSERT_EQ(
                NPLC_CALL(fmu, fmi3DoStep)(one.instance(), now, 2e-3, false, &flag, &flag, &flag, &reached),
                fmi3OK)
                << one.last_message();
            now = reached;
            again.push_back(one.outputs(variables));
        }
        EXPECT_EQ(again, first) << round;
    }
    // elsewhere, another course has begun in between: an instance's states are its own
    Fmu3 other(fmu);
    other.start();
    EXPECT_EQ(NPLC_CALL(fmu, fmi3SetFMUState)(other.instance(), state), fmi3Error);
    fmi3FMUState gone = state;
    EXPECT_EQ(NPLC_CALL(fmu, fmi3FreeFMUState)(one.instance(), &gone), fmi3OK);
    EXPECT_EQ(gone, nullptr);
    EXPECT_EQ(NPLC_CALL(fmu, fmi3SetFMUState)(one.instance(), state), fmi3Error);
    EXPECT_EQ(NPLC_CALL(fmu, fmi3FreeFMUState)(one.instance(), &gone), fmi3OK) << "a null state is none";
}

/// Every step is done twice, as an importer does that iterates.
TEST(FmuState, OfEveryStepCanBePutBack) {
    const FmuOptions options = options_of("pick_and_place.seq");
    const UnpackedFmu fmu(packed(options));
    const auto variables = variables_of(options.setup);
    Fmu3 straight(fmu);
    Fmu3 iterating(fmu);
    straight.start();
    iterating.start();
    fmi3FMUState state = nullptr;
    bool flag = false;
    double reached = 0;
    for (int i = 0; i < 800; ++i) {
        if (i == 300) {
            ASSERT_EQ(straight.set(Id::in0, true), fmi3OK);
            ASSERT_EQ(iterating.set(Id::in0, true), fmi3OK);
        }
        ASSERT_EQ(NPLC_CALL(fmu, fmi3GetFMUState)(iterating.instance(), &state), fmi3OK);
        ASSERT_EQ(iterating.set(Id::load_torque, 1.0), fmi3OK);
        ASSERT_EQ(NPLC_CALL(fmu, fmi3DoStep)(iterating.instance(), iterating.time(), 7e-3, false, &flag,
                                             &flag, &flag, &reached),
                  fmi3OK);
        ASSERT_EQ(NPLC_CALL(fmu, fmi3SetFMUState)(iterating.instance(), state), fmi3OK);
        ASSERT_EQ(iterating.step(1e-3), fmi3OK) << iterating.last_message();
        ASSERT_EQ(straight.step(1e-3), fmi3OK);
        ASSERT_EQ(iterating.outputs(variables), straight.outputs(variables)) << i;
    }
    EXPECT_GT(straight.integer(Id::p_ist), 1000);
}

TEST(FmuState, BeforeAndAfterAResetIsTheSame) {
    const FmuOptions options = options_of("");
    const UnpackedFmu fmu(packed(options));
    const auto variables = variables_of(options.setup);
    Fmu3 one(fmu);
    const auto course = [&] {
        EXPECT_EQ(one.set(Id::mode_reg, 1), fmi3OK) << one.last_message();
        one.start();
        return go_on(one, variables, 300);
    };
    const Course first = course();
    const fmi3FMUState state = saved(one);
    const Course further = go_on(one, variables, 50);
    ASSERT_EQ(NPLC_CALL(fmu, fmi3Reset)(one.instance()), fmi3OK);
    EXPECT_EQ(one.integer(Id::p_ist), 0);
    EXPECT_EQ(course(), first);
    ASSERT_EQ(NPLC_CALL(fmu, fmi3SetFMUState)(one.instance(), state), fmi3OK);
    EXPECT_EQ(go_on(one, variables, 50), further);
}

TEST(FmuState, IsNotSerialised) {
    const UnpackedFmu fmu(packed(options_of("")));
    EXPECT_NE(fmu.description().find("canSerializeFMUState=\"false\""), std::string::npos);
    Fmu3 one(fmu);
    std::size_t size = 0;
    EXPECT_EQ(NPLC_CALL(fmu, fmi3SerializedFMUStateSize)(one.instance(), saved(one), &size), fmi3Error);
    EXPECT_NE(one.last_message().find("does not offer"), std::string::npos) << one.last_message();
}

}  // namespace
}  // namespace nplc::sim::fmu
