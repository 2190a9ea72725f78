#include "registers/layout.h"

#include <gtest/gtest.h>

namespace nplc::registers {
namespace {

const Register& small(std::uint8_t number) {
    return *find(Model::mac140, number);
}

// 001 §3.2: a LongInt takes two register numbers. 004: every register is 32 bits wide.
TEST(Layout, WidthOnTheLine) {
    EXPECT_EQ(bytes_of(Model::mac140, small(P_SOLL)), 4);
    EXPECT_EQ(bytes_of(Model::mac140, small(V_SOLL)), 2);
    EXPECT_EQ(bytes_of(Model::mac140, small(KVOUT)), 2);
    EXPECT_EQ(bytes_of(Model::mac800, *find(Model::mac800, "V_SOLL")), 4);
    EXPECT_EQ(cells_of(Model::mac140, small(P_SOLL)).count, 2);
    EXPECT_EQ(cells_of(Model::mac140, small(V_SOLL)).count, 1);
    EXPECT_EQ(cells_of(Model::mac800, *find(Model::mac800, "P_SOLL")).count, 1);
}

// 001's titles of their own for 4, 9, 11, 21 .. 164, and "31 reserved".
TEST(Layout, SecondHalves) {
    for (const int number :
         {4, 9, 11, 21, 23, 25, 27, 29, 31, 39, 50, 52, 54, 56, 58, 60, 62, 64, 155, 159, 164}) {
        EXPECT_TRUE(is_second_half(Model::mac50, static_cast<std::uint8_t>(number))) << number;
        EXPECT_EQ(holder_of(Model::mac50, static_cast<std::uint8_t>(number))->number, number - 1);
        EXPECT_FALSE(is_second_half(Model::mac800, static_cast<std::uint8_t>(number))) << number;
    }
    EXPECT_FALSE(is_second_half(Model::mac50, 5));
    EXPECT_EQ(holder_of(Model::mac50, 5)->name, "V_SOLL");
    EXPECT_EQ(holder_of(Model::mac50, 0), nullptr);
    EXPECT_EQ(holder_of(Model::mac50, 165), nullptr);
    EXPECT_EQ(holder_of(Model::mac50, 255), nullptr);
    EXPECT_EQ(holder_of(Model::mac800, 50), nullptr);
    EXPECT_EQ(holder_of(Model::mac800, 4)->name, "P_NEW");
}

TEST(Layout, WhatAWriteReaches) {
    const Cells a_soll = cells_of(Model::mac140, small(A_SOLL));
    EXPECT_TRUE(overlap(cells_of_write(Model::mac140, V_SOLL, 4), a_soll));
    EXPECT_FALSE(overlap(cells_of_write(Model::mac140, V_SOLL, 2), a_soll));
    EXPECT_FALSE(overlap(cells_of_write(Model::mac800, V_SOLL, 4), a_soll));
    EXPECT_TRUE(overlap(cells_of_write(Model::mac140, 4, 2), cells_of(Model::mac140, small(P_SOLL))));
    EXPECT_FALSE(overlap(Cells{254, 2}, Cells{0, 1}));
}

}  // namespace
}  // namespace nplc::registers
