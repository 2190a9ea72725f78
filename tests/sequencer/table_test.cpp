#include "sequencer/table.h"

#include <gtest/gtest.h>

#include "tables.h"

namespace nplc::sequencer {
namespace {

// FastMAC format, step 0, condition always true but for ERROR, no switch, nothing sent.
constexpr TermBytes kIdle{0xC0, 0x00, 0x00, 0x3E, 0x80, 0x00, 0x00, 0x00};

TermBytes in_step(std::uint8_t step) {
    TermBytes term = kIdle;
    term[0] = static_cast<std::uint8_t>(0xC0 | step);
    return term;
}

TEST(Table, EndAloneIsAnEmptyTable) {
    const Bytes bytes = table_of({});
    const auto loaded = Table::load(bytes);
    ASSERT_TRUE(loaded.ok);
    EXPECT_TRUE(loaded.table.empty());
    EXPECT_EQ(loaded.table.size(), 0U);
}

TEST(Table, DefaultTableHasNoTerms) {
    const Table table;
    EXPECT_TRUE(table.empty());
    EXPECT_EQ(table.terms_of(0).begin, table.terms_of(0).end);
}

TEST(Table, EndIsToldByBits5To0AndBits7And6AreIgnored) {
    for (const std::uint8_t end : Bytes{0x3F, 0x7F, 0xBF, 0xFF}) {
        const Bytes bytes = bytes_of({kIdle, {end, 0xFF, 0x12, 0x3F, 0, 0, 0, 0}});
        const auto loaded = Table::load(bytes);
        ASSERT_TRUE(loaded.ok);
        EXPECT_EQ(loaded.table.size(), 1U);
    }
}

TEST(Table, WhatFollowsTheEndIsIgnored) {
    Bytes bytes = table_of({kIdle});
    const TermBytes refused_elsewhere{0x00, 0x00, 0x00, 0x3F, 0x00, 0x00, 0x00, 0x00};
    bytes.insert(bytes.end(), refused_elsewhere.begin(), refused_elsewhere.end());
    bytes.insert(bytes.end(), {0x01, 0x02, 0x03});
    const auto loaded = Table::load(bytes);
    ASSERT_TRUE(loaded.ok);
    EXPECT_EQ(loaded.table.size(), 1U);
}

TEST(Table, FirstEndCounts) {
    const Bytes bytes = bytes_of({kIdle, kEndTerm, kIdle, kEndTerm});
    EXPECT_EQ(Table::load(bytes).table.size(), 1U);
}

TEST(Table, MissingEndIsRefusedAtTheTermThatIsNotThere) {
    const Bytes bytes = bytes_of({kIdle, kIdle});
    const auto loaded = Table::load(bytes);
    ASSERT_FALSE(loaded.ok);
    EXPECT_EQ(loaded.fault.error, base::Error::table_no_end);
    EXPECT_EQ(loaded.fault.term, 2);
    EXPECT_TRUE(loaded.table.empty());
}

TEST(Table, NoBytesAreNoTable) {
    const auto loaded = Table::load({});
    ASSERT_FALSE(loaded.ok);
    EXPECT_EQ(loaded.fault.error, base::Error::table_no_end);
    EXPECT_EQ(loaded.fault.term, 0);
}

TEST(Table, CutInsideATermIsRefused) {
    for (std::size_t missing = 1; missing < kTermBytes; ++missing) {
        Bytes bytes = bytes_of({kIdle, kIdle});
        bytes.resize(bytes.size() - missing);
        const auto loaded = Table::load(bytes);
        ASSERT_FALSE(loaded.ok) << missing;
        EXPECT_EQ(loaded.fault.error, base::Error::table_ragged) << missing;
        EXPECT_EQ(loaded.fault.term, 1) << missing;
    }
}

TEST(Table, CutInsideTheEndTermIsRefusedToo) {
    Bytes bytes = table_of({kIdle});
    bytes.pop_back();
    const auto loaded = Table::load(bytes);
    ASSERT_FALSE(loaded.ok);
    EXPECT_EQ(loaded.fault.error, base::Error::table_ragged);
    EXPECT_EQ(loaded.fault.term, 1);
}

TEST(Table, NextState3FIsRefusedWithTheTermsNumber) {
    for (const std::uint8_t next : Bytes{0x3F, 0x7F, 0xBF, 0xFF}) {
        const Bytes bytes = table_of({kIdle, kIdle, {0xC0, 0, 0, next, 0x80, 0, 0, 0}, kIdle});
        const auto loaded = Table::load(bytes);
        ASSERT_FALSE(loaded.ok);
        EXPECT_EQ(loaded.fault.error, base::Error::bad_next_step);
        EXPECT_EQ(loaded.fault.term, 2);
    }
}

TEST(Table, NextState3EAndEveryStepBelowAreTaken) {
    for (int next = 0; next <= 0x3E; ++next) {
        const Bytes bytes = table_of({{0xC0, 0, 0, static_cast<std::uint8_t>(next), 0x80, 0, 0, 0}});
        EXPECT_TRUE(Table::load(bytes).ok) << next;
    }
}

TEST(Table, FlexRegister0IsRefusedWithTheTermsNumber) {
    for (const std::uint8_t reg : Bytes{0x00, 0x80}) {
        const Bytes bytes = table_of({kIdle, {0xC0, 0, 0x80, reg, 0, 0, 0, 0}});
        const auto loaded = Table::load(bytes);
        ASSERT_FALSE(loaded.ok);
        EXPECT_EQ(loaded.fault.error, base::Error::bad_register);
        EXPECT_EQ(loaded.fault.term, 1);
    }
}

// Byte 3 is a register number there, not a step.
TEST(Table, FlexRegister63And127AreTaken) {
    const Bytes bytes = table_of({{0xC0, 0, 0x80, 0x3F, 0, 0, 0, 0}, {0xC0, 0, 0x80, 0x7F, 0, 0, 0, 0}});
    EXPECT_TRUE(Table::load(bytes).ok);
}

TEST(Table, Step62IsALegalState) {
    const Bytes bytes = table_of({in_step(62)});
    const auto loaded = Table::load(bytes);
    ASSERT_TRUE(loaded.ok);
    EXPECT_EQ(loaded.table.terms_of(62).begin, 0);
    EXPECT_EQ(loaded.table.terms_of(62).end, 1);
}

TEST(Table, Holds1024Terms) {
    Bytes bytes;
    for (int i = 0; i < 1024; ++i) bytes.insert(bytes.end(), kIdle.begin(), kIdle.end());
    bytes.insert(bytes.end(), kEndTerm.begin(), kEndTerm.end());
    const auto loaded = Table::load(bytes);
    ASSERT_TRUE(loaded.ok);
    EXPECT_EQ(loaded.table.size(), 1024U);
    EXPECT_EQ(loaded.table.terms_of(0).end, 1024);
}

TEST(Table, Refuses1025Terms) {
    Bytes bytes;
    for (int i = 0; i < 1025; ++i) bytes.insert(bytes.end(), kIdle.begin(), kIdle.end());
    bytes.insert(bytes.end(), kEndTerm.begin(), kEndTerm.end());
    const auto loaded = Table::load(bytes);
    ASSERT_FALSE(loaded.ok);
    EXPECT_EQ(loaded.fault.error, base::Error::no_space);
    EXPECT_EQ(loaded.fault.term, 1024);
}

TEST(Table, IndexSpansAStepsFirstToItsLastTerm) {
    const Bytes bytes = table_of({in_step(7), in_step(1), in_step(7), in_step(2), in_step(1)});
    const Table table = Table::load(bytes).table;
    EXPECT_EQ(table.terms_of(7).begin, 0);
    EXPECT_EQ(table.terms_of(7).end, 3);
    EXPECT_EQ(table.terms_of(1).begin, 1);
    EXPECT_EQ(table.terms_of(1).end, 5);
    EXPECT_EQ(table.terms_of(2).begin, 3);
    EXPECT_EQ(table.terms_of(2).end, 4);
    EXPECT_EQ(table.terms_of(3).begin, table.terms_of(3).end);
}

TEST(Table, IsUsedWhereItLies) {
    const Bytes bytes = table_of({kIdle, in_step(9)});
    const Table table = Table::load(bytes).table;
    EXPECT_EQ(table.term(0).data(), bytes.data());
    EXPECT_EQ(table.term(1).data(), bytes.data() + 8);
}

TEST(Table, AssignForgetsTheTableBefore) {
    const Bytes before = table_of({in_step(4), in_step(9)});
    const Bytes after = table_of({in_step(1)});
    Table table = Table::load(before).table;
    ASSERT_EQ(table.assign(after), std::nullopt);
    EXPECT_EQ(table.terms_of(1).end, 1);
    for (const std::uint8_t step : std::array<std::uint8_t, 2>{4, 9})
        EXPECT_EQ(table.terms_of(step).begin, table.terms_of(step).end);
    EXPECT_EQ(table.size(), 1);
}

TEST(Table, EveryFaultHasItsOwnWords) {
    const std::array faults{base::Error::table_ragged, base::Error::table_no_end,
                            base::Error::no_space,     base::Error::bad_next_step,
                            base::Error::bad_register, base::Error::not_for_motor};
    for (const auto a : faults) {
        EXPECT_NE(describe(a), describe(base::Error::not_stopped));
        for (const auto b : faults) EXPECT_EQ(describe(a) == describe(b), a == b);
    }
}

}  // namespace
}  // namespace nplc::sequencer
