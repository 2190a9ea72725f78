// The faces of a simulated machine.
#include "sim_faces.h"

#include <gtest/gtest.h>

#include "program.h"

namespace nplc::sim {
namespace {

TEST(SimFaces, ShowTheUnitOfTheProgramsScale) {
    Names names;
    names.machine = MachineUnit{.name = "mm", .per_rev = 5};
    SimFaces scaled(names);
    EXPECT_EQ(scaled.model().scaling().unit, "mm");
    EXPECT_EQ(scaled.model().scaling().per_revolution, 5);
    SimFaces plain(Names{});
    EXPECT_EQ(plain.model().scaling().unit, "rev");
    EXPECT_EQ(plain.model().scaling().per_revolution, 1);
}

TEST(World, SaysWhetherTheLineIsCutAndTheShaftBlocked) {
    World world(load_program(MENDING).table, {});
    EXPECT_FALSE(world.line_is_cut());
    world.cut_line(true);
    EXPECT_TRUE(world.line_is_cut());
    world.cut_line(false);
    EXPECT_FALSE(world.line_is_cut());
    world.act(action::StopMotor{.above = true, .counts = 100});
    EXPECT_FALSE(world.shaft_is_blocked()) << "at an end";
    world.act(action::StopMotor{.above = false, .counts = -100});
    EXPECT_FALSE(world.shaft_is_blocked()) << "between two ends";
    world.act(action::StopMotor{.above = true, .counts = 0});
    world.act(action::StopMotor{.above = false, .counts = 0});
    EXPECT_TRUE(world.shaft_is_blocked());
    world.act(action::FreeMotor{});
    EXPECT_FALSE(world.shaft_is_blocked());
}

}  // namespace
}  // namespace nplc::sim
