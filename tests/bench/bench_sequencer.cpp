// bench_sequencer            time per scan of the engine, a table walk and compiled code
// bench_sequencer --check    only that all four give the same trace; exit code 1 if not
//
// Google Benchmark's own options are taken as well.
#include <benchmark/benchmark.h>

#include <cstdio>
#include <cstring>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "bench_generated.h"
#include "bench_main.h"
#include "machines.h"
#include "shapes.h"

namespace nplc::bench {
namespace {

constexpr std::size_t kStream = 1U << 18;
constexpr std::size_t kCheckedScans = 200'000;
constexpr std::size_t kBatch = 2048;

/// Inputs and IN_POS uniform, ERROR in one scan of 32.
std::vector<std::uint8_t> random_images() {
    std::mt19937_64 random(7);
    std::vector<std::uint8_t> images(kStream);
    for (auto& image : images) {
        const std::uint64_t bits = random();
        image = static_cast<std::uint8_t>((bits & 0x7F) | (bits % 4096 < 128 ? 0x80U : 0U));
    }
    return images;
}

const std::vector<std::uint8_t>& images() {
    static const std::vector<std::uint8_t> all = random_images();
    return all;
}

struct Point {
    State state;
    std::uint64_t hash = 0;
    bool operator==(const Point&) const = default;
};

template <class Machine>
std::vector<Point> trace(Machine machine) {
    std::vector<Point> points;
    points.reserve(kCheckedScans);
    for (std::size_t i = 0; i < kCheckedScans; ++i) {
        machine.scan(images()[i]);
        points.push_back({machine.state(), machine.hash()});
    }
    return points;
}

bool equal(const std::string& what, const std::vector<Point>& a, const std::vector<Point>& b) {
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (a[i] == b[i]) continue;
        std::fprintf(stderr, "%s differs from the switch at scan %zu: step %u, there %u\n", what.c_str(), i,
                     b[i].state.step, a[i].state.step);
        return false;
    }
    return true;
}

/// A benchmark that waits in one step, or sends nothing, would measure nothing.
bool is_lively(const std::string& name, Size size, const std::vector<Point>& points) {
    std::map<unsigned, std::size_t> visits;
    for (const Point& point : points) ++visits[point.state.step];
    if (visits.size() == static_cast<std::size_t>(size.steps) && points.back().hash != 0) return true;
    std::fprintf(stderr, "%s: only %zu of %d steps are reached\n", name.c_str(), visits.size(), size.steps);
    return false;
}

template <class Switch, class StCase>
struct Case {
    Size size;
    Loaded loaded;

    Case(Size size_, std::span<const std::uint8_t> bytes) : size(size_), loaded(bytes) {}

    bool check() const {
        const std::string name = name_of(size);
        const std::vector<Point> expected = trace(SwitchMachine<Switch>());
        return is_lively(name, size, expected) &&
               equal(name + ": ST CASE", expected, trace(CaseMachine<StCase>())) &&
               equal(name + ": engine in place", expected, trace(loaded.in_place())) &&
               equal(name + ": table walk", expected, trace(loaded.walk()));
    }

    void enlist() const;
};

template <class Machine>
void run(benchmark::State& state, Machine machine) {
    const std::uint8_t* const stream = images().data();
    std::size_t at = 0;
    for (auto _ : state) {
        for (std::size_t i = 0; i < kBatch; ++i) machine.scan(stream[at + i]);
        at = (at + kBatch) % kStream;
        benchmark::DoNotOptimize(machine);
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kBatch));
}

template <class Switch, class StCase>
void Case<Switch, StCase>::enlist() const {
    const std::string name = name_of(size);
    const auto add = [&name](const std::string& column, auto make) {
        benchmark::RegisterBenchmark((name + "/" + column).c_str(),
                                     [make](benchmark::State& state) { run(state, make()); });
    };
    add("ST CASE", [] { return CaseMachine<StCase>(); });
    add("switch", [] { return SwitchMachine<Switch>(); });
    add("in place", [this] { return loaded.in_place(); });
    add("walk", [this] { return loaded.walk(); });
}

/// Google Benchmark's console, and the medians kept for the table at the end.
class Reporter : public benchmark::ConsoleReporter {
  public:
    void ReportRuns(const std::vector<Run>& runs) override {
        ConsoleReporter::ReportRuns(runs);
        for (const Run& run : runs) {
            const bool median = run.run_type == Run::RT_Aggregate && run.aggregate_name == "median";
            if (!median && run.run_type != Run::RT_Iteration) continue;
            const double ns = run.GetAdjustedCPUTime() / static_cast<double>(kBatch);
            if (median || medians_.count(run.run_name.function_name) == 0) {
                medians_[run.run_name.function_name] = ns;
            }
        }
    }

    void print_table() const {
        if (medians_.size() != 4 * kSizes.size()) return;
        std::printf("\nMedian ns per scan\n\n");
        std::printf("| steps x terms | ST CASE | switch | in place | walk ");
        std::printf("| in place / ST CASE | walk / in place |\n");
        std::printf("| --- | --- | --- | --- | --- | --- | --- |\n");
        for (const Size size : kSizes) {
            const auto ns = [&](const char* column) { return medians_.at(name_of(size) + "/" + column); };
            std::printf("| %s | %.1f | %.1f | %.1f | %.1f | %.2f | %.1f |\n", name_of(size).c_str(),
                        ns("ST CASE"), ns("switch"), ns("in place"), ns("walk"),
                        ns("in place") / ns("ST CASE"), ns("walk") / ns("in place"));
        }
    }

  private:
    std::map<std::string, double> medians_;
};

int run_all(int argc, char** argv) {
    const Case<Switch_8x1, Case_8x1> small(kSizes[0], kTable_8x1);
    const Case<Switch_62x1, Case_62x1> one(kSizes[1], kTable_62x1);
    const Case<Switch_62x4, Case_62x4> four(kSizes[2], kTable_62x4);
    const Case<Switch_62x16, Case_62x16> sixteen(kSizes[3], kTable_62x16);
    if (!small.check() || !one.check() || !four.check() || !sixteen.check()) return 1;
    std::printf("%zu scans of each size: the four traces are equal\n", kCheckedScans);
    if (argc == 2 && std::strcmp(argv[1], "--check") == 0) return 0;

    small.enlist();
    one.enlist();
    four.enlist();
    sixteen.enlist();
    std::string defaults[] = {"--benchmark_repetitions=15", "--benchmark_min_time=0.05",
                              "--benchmark_enable_random_interleaving=true",
                              "--benchmark_display_aggregates_only=true"};
    std::vector<char*> args{argv[0]};
    for (std::string& option : defaults) args.push_back(option.data());
    for (int i = 1; i < argc; ++i) args.push_back(argv[i]);
    int count = static_cast<int>(args.size());
    benchmark::Initialize(&count, args.data());
    if (benchmark::ReportUnrecognizedArguments(count, args.data())) return 2;
    Reporter reporter;
    benchmark::RunSpecifiedBenchmarks(&reporter);
    reporter.print_table();
    return 0;
}

}  // namespace
}  // namespace nplc::bench

int main(int argc, char** argv) {
    return nplc::bench::guarded("bench_sequencer", nplc::bench::run_all, argc, argv);
}
