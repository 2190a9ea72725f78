// compile(decompile(table)) == table, for random tables of all kinds.
#include <gtest/gtest.h>

#include <cstdio>

#include "seqc/decompile.h"
#include "support.h"

namespace nplc::seqc {
namespace {

using Bytes = std::vector<std::uint8_t>;
using Term = std::array<unsigned, 8>;
using test::Random;

void add(Bytes& table, const Term& term) {
    for (unsigned byte : term) table.push_back(static_cast<std::uint8_t>(byte));
}

Bytes ended(Bytes table) {
    add(table, {0x3F, 0, 0, 0, 0, 0, 0, 0});
    return table;
}

/// The program, which was held against the table.
Decompilation round_trip(const Bytes& table, unsigned seed) {
    const Decompilation result = decompile(table, {.origin = "random.bin", .motor = {}});
    EXPECT_EQ(result.error, "") << "seed " << seed;
    const Compilation again = compile(result.text);
    EXPECT_TRUE(again.ok) << "seed " << seed << "\n" << test::shown(again, result.text) << result.text;
    EXPECT_EQ(again.table, table) << "seed " << seed << "\n" << result.text;
    return result;
}

Term random_bytes(Random& random) {
    Term term{};
    for (unsigned& byte : term) byte = random() & 0xFFU;
    if ((term[0] & 0x3FU) == 0x3FU) term[0] ^= 1U;
    return term;
}

/// A term that symbols can express, for steps 0..`steps` - 1.
Term canonical(Random& random, unsigned step, unsigned steps) {
    Term t{step | (random() % 4 == 0 ? 0U : 0x80U) | (random() % 6 == 0 ? 0U : 0x40U), 0, 0, 0, 0, 0, 0, 0};
    for (unsigned n = random() % 4; n > 0; --n) t[2] |= 1U << (random() % 7);
    t[1] = (random() & t[2]) | (random() % 4 == 0 ? 0x80U : 0U);
    if (random() % 8 == 0) {
        t[2] |= 0x80U;
        t[3] = 65 + random() % 8;  // V1..V8, 16 bits signed
        t[4] = random() & 0xFFU;
        t[5] = random() & 0x7FU;
        return t;
    }
    t[3] = random() % 5 == 0 ? 0x3EU : random() % steps;
    t[4] = random() % 3 != 0 ? 0x80U : random() % 2 == 0 ? 0x40U + random() % 8 : 0x60U + random() % 8;
    t[5] = (random() & 0x0FU) | (random() % 8 == 0 ? 0x80U : 0U) | (random() % 8 == 0 ? 0x40U : 0U);
    if (random() % 3 == 0) {
        t[6] = 1 + random() % 255;
        t[7] = random() & 0xFFU;
        t[3] |= random() % 3 == 0 ? 0x40U : 0U;
    }
    return t;
}

TEST(DecompileRandom, AnyBytes) {
    for (unsigned seed = 1; seed <= 150; ++seed) {
        Random random(seed);
        Bytes table;
        for (unsigned n = random() % 30; n > 0; --n) add(table, random_bytes(random));
        Term end = random_bytes(random);
        end[0] |= 0x3FU;
        add(table, end);
        round_trip(table, seed);
    }
}

TEST(DecompileRandom, CanonicalTermsStepByStepNeedNoBytes) {
    for (unsigned seed = 1; seed <= 150; ++seed) {
        Random random(seed);
        Bytes table;
        const unsigned steps = 1 + random() % 8;
        for (unsigned step = 0; step < steps; ++step) {
            for (unsigned n = random() % 6; n > 0; --n) add(table, canonical(random, step, steps));
        }
        EXPECT_EQ(round_trip(ended(table), seed).byte_terms, 0U) << seed;
    }
}

TEST(DecompileRandom, InterleavedStepsNeedNoBytesEither) {
    for (unsigned seed = 1; seed <= 80; ++seed) {
        Random random(seed);
        Bytes table;
        const unsigned steps = 1 + random() % 62;
        for (unsigned n = 1 + random() % 40; n > 0; --n)
            add(table, canonical(random, random() % steps, steps));
        EXPECT_EQ(round_trip(ended(table), seed).byte_terms, 0U) << seed;
    }
}

TEST(DecompileRandom, StepSixtyTwoAndBadBytesAmongGoodOnes) {
    for (unsigned seed = 1; seed <= 80; ++seed) {
        Random random(seed);
        Bytes table;
        for (unsigned n = 1 + random() % 20; n > 0; --n) {
            Term term = canonical(random, random() % 16 == 0 ? 62U : n / 4, 8);
            if (random() % 8 == 0) term[random() % 8] ^= 1U << (random() % 8);
            if ((term[0] & 0x3FU) == 0x3FU) term[0] ^= 1U;
            add(table, term);
        }
        round_trip(ended(table), seed);
    }
}

TEST(DecompileRandom, CompiledProgramsComeBackAsBranches) {
    std::size_t structured = 0;
    std::size_t others = 0;
    for (unsigned seed = 1; seed <= 100; ++seed) {
        Random random(seed);
        const auto condition = [&] {
            const char* const literals[] = {"A", "NOT A", "B",       "NOT B",    "C",
                                            "D", "INPOS", "TIMER.Q", "COUNTER.Q"};
            std::string text = literals[random() % 9];
            if (random() % 2 == 0)
                text += (random() % 4 == 0 ? " OR " : " AND ") + std::string(literals[random() % 9]);
            return text;
        };
        const unsigned steps = 2 + random() % 6;
        const auto to = [&] { return "T" + std::to_string(random() % steps); };
        std::string body;
        for (unsigned i = 0; i < steps; ++i) {
            const char* const outs[] = {"", "OUT W;", "OUT X, Y;"};
            const char* const whens[] = {"", "", "", "OUT Z WHEN E;", "OUT Z WHEN NOT E AND A;"};
            const char* const entries[] = {"", "", "ENTRY STOP;", "ENTRY TIMER := T#2s;"};
            const char* const acts[] = {"",
                                        "",
                                        "RESET_ERROR; ",
                                        "POSITION(P3); ",
                                        "V_SOLL := 100; ",
                                        "COUNT_DOWN; ",
                                        "COUNTER := 3; "};
            body += "STEP T" + std::to_string(i) + ": " + outs[random() % 3] + whens[random() % 5] +
                    entries[random() % 4] + "\n";
            const unsigned branches = random() % 4;
            for (unsigned b = 0; b < branches; ++b) {
                body += (b == 0 ? "IF " : "ELSIF ") + condition() + " THEN " + acts[random() % 7] +
                        "NEXT := " + to() + ";\n";
            }
            body += std::string(branches > 0 ? "END_IF " : "") + "END_STEP\n";
        }
        const std::string source = test::program("STEP S: NEXT := T0; END_STEP " + body);
        const Compilation result = compile(source);
        if (!result.ok) continue;
        const Decompilation back = round_trip(result.table, seed);
        EXPECT_EQ(back.byte_terms, 0U) << source << back.text;
        structured += back.structured_steps;
        others += back.mixed_steps + back.term_steps;
    }
    EXPECT_GT(structured, 100U);
    // Where the compiler saved terms by letting later ones override earlier ones, TERMs come back.
    std::printf("%u steps came back as branches, %u with TERMs\n", static_cast<unsigned>(structured),
                static_cast<unsigned>(others));
    EXPECT_LT(others, 2 * structured);
}

TEST(DecompileRandom, LongTables) {
    for (const unsigned count : {1000U, 1023U, 1024U, 1025U, 3000U}) {
        Random random(count);
        Bytes table;
        for (unsigned i = 0; i < count; ++i) add(table, canonical(random, i * 62 / count, 62));
        const Decompilation result = round_trip(ended(table), count);
        EXPECT_EQ(result.byte_terms, 0U) << count;
    }
    Random random(7);
    Bytes table;
    for (unsigned i = 0; i < 1024; ++i) add(table, random_bytes(random));
    round_trip(ended(table), 7);
    Bytes one_step;
    for (unsigned i = 0; i < 1000; ++i) add(one_step, canonical(random, 5, 62));
    round_trip(ended(one_step), 7);
}

}  // namespace
}  // namespace nplc::seqc
