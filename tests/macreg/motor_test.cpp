#include "macreg/motor.h"

#include <gtest/gtest.h>

#include <iostream>

#include "bench.h"

namespace nplc::macreg {
namespace {

using registers::Model;

TEST(Motor, ReadsByWidthAndSign) {
    Bench bench;
    bench.put("V_SOLL", -5);
    bench.put("P_IST", -70'000);
    bench.put("A_SOLL", 40'000);  // a Word: no sign
    EXPECT_EQ(bench.motor.read("V_SOLL"), -5);
    EXPECT_EQ(bench.motor.read("P_IST"), -70'000);
    EXPECT_EQ(bench.motor.read("A_SOLL"), 40'000);
}

// 001 §3.2.5, §3.2.6: four bytes written to V_SOLL would reach A_SOLL.
TEST(Motor, WritesNoMoreThanTheRegister) {
    Bench bench;
    bench.put("A_SOLL", 123);
    bench.motor.write(bench.reg("V_SOLL"), -1);
    EXPECT_EQ(bench.at("V_SOLL"), -1);
    EXPECT_EQ(bench.at("A_SOLL"), 123);
    bench.motor.write(bench.reg("P_HOME"), -2);
    EXPECT_EQ(bench.at("P_HOME"), -2);
    EXPECT_EQ(bench.at("V_HOME"), -400);  // the next but one
}

TEST(Motor, EveryRegisterOfEveryModelIsReadAsAloneAndInBlocks) {
    for (const Model model : {Model::mac140, Model::mac800}) {
        Bench bench(model);
        std::vector<const registers::Register*> all;
        for (const auto& reg : bench.motor.map()) all.push_back(&reg);
        const Snapshot snapshot = bench.motor.read_block(all);
        const auto questions = bench.master.counters().questions;
        EXPECT_LE(questions, 256U / block_numbers(model) + 6) << questions;
        for (const auto* reg : all) {
            if (reg->access == registers::Access::read_only) continue;  // they change meanwhile
            EXPECT_EQ(snapshot.find(reg->number), bench.motor.read(*reg)) << reg->name;
            EXPECT_EQ(snapshot.at(reg->number), bench.sim.read(reg->number)) << reg->name;
        }
    }
}

TEST(Motor, ModelIsFoundByReading) {
    Bench small(Model::mac95);
    EXPECT_EQ(Motor::find_model(small.master, kAddress), Model::mac140);  // for all of MAC50 to MAC141
    Bench large(Model::mac800);
    EXPECT_EQ(Motor::find_model(large.master, kAddress), Model::mac800);
}

// P_REG_P adds at each write when positions are relative: an accept that is lost must not write twice.
TEST(Motor, WhatAddsIsNotWrittenTwice) {
    Bench bench;
    bench.put("P1", 1000);
    bench.put("ERR_STAT", 1 << 9);  // RELPOSPSOLL
    bench.wire.from_unit().cut();
    EXPECT_THROW(bench.motor.write(bench.reg("P_REG_P"), 1), Unconfirmed);
    EXPECT_EQ(bench.at("P_SOLL"), 1000);
}

TEST(Motor, NoiseCostsRepeatsAndNoValue) {
    for (const std::uint64_t seed : {1U, 2U, 3U, 4U}) {
        std::cout << "seed " << seed << '\n';
        Bench bench(Model::mac140, seed);
        bench.wire.set_faults({.drop = 0.003, .damage = 0.003, .framing = 0.003});
        for (int i = 0; i < 40; ++i) {
            bench.motor.write(bench.reg("V_SOLL"), 100 + i);
            EXPECT_EQ(bench.motor.read("V_SOLL"), 100 + i);
            EXPECT_EQ(bench.at("A_SOLL"), 160);
        }
        EXPECT_GT(bench.master.counters().timeouts, 0U);
    }
}

// A block has 139 characters (001 §5.1): at 1 % a character no more than a quarter of them comes whole.
TEST(Motor, ABlockThatComesDamagedIsReadInParts) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        Bench bench(seed % 2 == 0 ? Model::mac140 : Model::mac800, seed);
        bench.wire.set_faults({.damage = 0.01});
        std::vector<const registers::Register*> all;
        for (const auto& reg : bench.motor.map()) all.push_back(&reg);
        mactalk_client::Master patient(bench.wire, {.attempts = 10});
        Motor motor(patient, kAddress, bench.motor.model());
        EXPECT_NO_THROW(EXPECT_EQ(motor.read_block(all).values().size(), all.size())) << "seed " << seed;
    }
}

TEST(Motor, AfterGoodAnswersTheSpeedIsNotBlamed) {
    Bench bench;
    bench.motor.read("V_SOLL");
    bench.wire.set_faults({.damage = 0.05});
    try {
        for (;;) bench.motor.read("V_SOLL");
    } catch (const mactalk_client::LineError& error) {
        EXPECT_NE(std::string(error.what()).find("damaged: check wiring"), std::string::npos) << error.what();
    }
}

// A motor that goes dark after a line that was noisy once: silence is no damage.
TEST(Motor, SilenceIsNotBlamedOnTheWiring) {
    Bench bench;
    bench.wire.set_faults({.damage = 0.02});
    for (int i = 0; i < 50; ++i) {
        try {
            bench.motor.read("V_SOLL");
        } catch (const mactalk_client::LineError&) {  // noise
        }
    }
    ASSERT_GT(bench.master.counters().stray_bytes, 0U);
    bench.wire.set_faults({});
    bench.units.dead = true;
    bench.run(base::Milliseconds{500});
    try {
        bench.motor.read("V_SOLL");
        FAIL();
    } catch (const mactalk_client::LineError& error) {
        EXPECT_NE(std::string(error.what()).find("nothing came, though others were answered"),
                  std::string::npos)
            << error.what();
        EXPECT_EQ(std::string(error.what()).find("wiring"), std::string::npos) << error.what();
    }
}

// After a frame cut short by a pause the next whole one is understood.
TEST(Motor, IsInStepAgainWithinOneFrame) {
    Bench bench;
    const std::vector<std::uint8_t> noise{0x52, 0x52, 0x52, 0x00, 0xFF, 0x05};
    static_cast<void>(bench.wire.write(noise));
    bench.run(base::Milliseconds{20});
    bench.master.read(kAddress, 5);
    EXPECT_LE(bench.master.counters().timeouts, 1U);
}

}  // namespace
}  // namespace nplc::macreg
