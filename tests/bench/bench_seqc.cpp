// How long compile() takes. --check only looks at the programs that are compiled, and is a
// test; --print writes the full program.
#include <benchmark/benchmark.h>

#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>

#include "bench_main.h"
#include "seqc/seqc.h"
#include "seqc_programs.h"

namespace nplc::bench {
namespace {

std::string example(const char* file) {
    std::ifstream in(std::string(SEQC_EXAMPLES "/") + file);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// Named steps and terms of `source`, or a complaint and false.
bool has_size(const char* what, const std::string& source, std::size_t steps, std::size_t terms) {
    const seqc::Compilation result = seqc::compile(source);
    for (const seqc::Diagnostic& d : result.diagnostics) std::printf("%s", render(d, source, what).c_str());
    if (!result.ok) return false;
    std::size_t named = 0;
    for (std::size_t i = 1; i < result.symbols.steps.size(); ++i)
        if (!result.symbols.steps[i].empty()) ++named;
    const std::size_t made = result.table.size() / 8 - 1;
    std::printf("%s: %zu named steps, %zu terms\n", what, named, made);
    if (named == steps && (terms == 0 || made == terms)) return true;
    std::printf("%s should have %zu named steps and %zu terms\n", what, steps, terms);
    return false;
}

bool check() {
    bool right = has_size("full program", full_program(), kFullSteps, kFullTerms);
    right = has_size("full machine", machine_program(kMachineUnits, kMachineRests), kFullSteps, 0) && right;
    right = has_size("worst program", worst_program(), kFullSteps, 0) && right;
    return has_size("pick_and_place", example("pick_and_place.seq"), 6, 0) && right;
}

void compile(benchmark::State& state, const std::string& source) {
    for (auto _ : state) benchmark::DoNotOptimize(seqc::compile(source));
}

int run_all(int argc, char** argv) {
    if (argc == 2 && std::strcmp(argv[1], "--check") == 0) return check() ? 0 : 1;
    if (argc == 2 && std::strcmp(argv[1], "--print") == 0) {
        std::fputs(full_program().c_str(), stdout);
        return 0;
    }
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    for (auto [name, source] :
         {std::pair{"compile/pick_and_place", example("pick_and_place.seq")},
          std::pair{"compile/full program", full_program()},
          std::pair{"compile/half a machine", machine_program(kMachineUnits / 2, kMachineRests / 2)},
          std::pair{"compile/full machine", machine_program(kMachineUnits, kMachineRests)},
          std::pair{"compile/worst program", worst_program()}}) {
        benchmark::RegisterBenchmark(name, compile, source)->Unit(benchmark::kMillisecond);
    }
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}

}  // namespace
}  // namespace nplc::bench

int main(int argc, char** argv) {
    return nplc::bench::guarded("bench_seqc", nplc::bench::run_all, argc, argv);
}
