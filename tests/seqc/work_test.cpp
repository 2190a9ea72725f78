// Compiling takes work in proportion to the program: counted in allocations, which are the same in every run.
#include <gtest/gtest.h>

#include <cstdlib>
#include <new>
#include <string>

#include "../bench/seqc_programs.h"
#include "seqc/seqc.h"

namespace {

std::size_t allocations = 0;

}  // namespace

void* operator new(std::size_t size) {
    ++allocations;
    if (void* memory = std::malloc(size)) return memory;
    throw std::bad_alloc();
}

void operator delete(void* memory) noexcept {
    std::free(memory);
}

void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}

namespace nplc::seqc {
namespace {

struct Work {
    std::size_t allocations;
    std::size_t bytes;  ///< of the source
};

Work work_of(unsigned units, unsigned rests) {
    const std::string source = bench::machine_program(units, rests);
    compile(source);  // what is allocated once and kept
    const std::size_t before = allocations;
    const Compilation result = compile(source);
    const std::size_t after = allocations;
    EXPECT_TRUE(result.ok && result.diagnostics.empty());
    return {after - before, source.size()};
}

// From one unit to three and from three to five the text grows alike. With quadratic work the second step
// takes (25 - 9) / (9 - 1) = 2 times the first.
TEST(Work, GrowsAsAProgramOfGroupsLimitsEdgesAndCallsDoes) {
    const Work one = work_of(1, 0), three = work_of(3, 0), five = work_of(5, 0);
    ASSERT_EQ(five.bytes - three.bytes, three.bytes - one.bytes);
    ASSERT_GT(three.allocations, one.allocations);
    EXPECT_LT(five.allocations - three.allocations, (three.allocations - one.allocations) * 3 / 2);
}

// A table holds 61 steps of a program; the program that fills it so takes no more for each of them, on the
// whole, than twice what a sixth of it takes.
TEST(Work, OfAFullTableIsInProportionToItsSteps) {
    const Work sixth = work_of(1, 0), full = work_of(bench::kMachineUnits, bench::kMachineRests);
    constexpr std::size_t kStepsOfSixth = 12;
    EXPECT_LT(full.allocations * kStepsOfSixth, 2 * sixth.allocations * bench::kFullSteps);
}

}  // namespace
}  // namespace nplc::seqc
