// How many seconds of a motor's life a second computes, and a step response of the model for tools/plot_step.
#include <benchmark/benchmark.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <tuple>

#include "bench_main.h"
#include "sim/mac_motor.h"

namespace nplc::bench {
namespace {

using sim::MacMotor;
using sim::MacMotorOptions;
using sim::Servo;
using enum registers::Number;

void set(MacMotor& motor, int reg, std::int32_t value) {
    motor.write(static_cast<std::uint8_t>(reg), value);
}

/// Moves to and fro in position mode, so that every part of a move is timed.
void samples(benchmark::State& state, registers::Model model, Servo::Depth depth) {
    const auto count = static_cast<std::size_t>(state.range(0));
    std::deque<MacMotor> motors;
    for (std::size_t i = 0; i < count; ++i) {
        MacMotorOptions options;
        options.depth = depth;
        options.order_limit = 1;
        motors.emplace_back(model, options);
        set(motors.back(), MODE_REG, 2);
    }
    constexpr int kSamples = 250;
    std::int32_t target = 20'000;
    for (auto _ : state) {
        for (MacMotor& motor : motors) {
            set(motor, P_SOLL, target);
            for (int i = 0; i < kSamples; ++i) motor.sample();
        }
        target = -target;
    }
    const double seconds = 1e-9 * static_cast<double>(motors.front().sample_period().count()) * kSamples;
    state.counters["simulated_s"] =
        benchmark::Counter(seconds * static_cast<double>(count) * static_cast<double>(state.iterations()),
                           benchmark::Counter::kIsRate);
}

/// A move of a revolution in position mode: CSV, a row a sample.
int print_step(double kvout, double inertia) {
    MacMotorOptions options;
    options.load.inertia_256 = static_cast<std::int32_t>(inertia * 256);
    MacMotor motor(registers::Model::mac140, options);
    set(motor, KVOUT, static_cast<std::int32_t>(kvout * 256));
    set(motor, MODE_REG, 2);
    set(motor, P_SOLL, motor.counts_per_revolution());
    std::puts("time_ms,fnc_out,v_ist,p_fnc,p_ist,flwerr,vf_out");
    for (int i = 0; i < 120; ++i) {
        motor.sample();
        std::printf("%.2f,%.3f,%d,%.3f,%d,%d,%d\n", 1.92 * i, motor.read(FNC_OUT) / 16.0, motor.v_ist(),
                    motor.read(P_FNC) / 16.0, motor.p_ist(), motor.read(FLWERR), motor.torque());
    }
    return 0;
}

int run_all(int argc, char** argv) {
    if (argc == 4 && std::strcmp(argv[1], "--step") == 0)
        return print_step(std::atof(argv[2]), std::atof(argv[3]));
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    using registers::Model;
    for (const auto& [name, model, depth] :
         {std::tuple{"motor/MAC140 current loop", Model::mac140, Servo::Depth::current_loop},
          std::tuple{"motor/MAC140 outer loop", Model::mac140, Servo::Depth::outer_loop},
          std::tuple{"motor/MAC800 current loop", Model::mac800, Servo::Depth::current_loop},
          std::tuple{"motor/MAC800 outer loop", Model::mac800, Servo::Depth::outer_loop}}) {
        benchmark::RegisterBenchmark(name, samples, model, depth)
            ->RangeMultiplier(2)
            ->Range(1, 8)
            ->Unit(benchmark::kMicrosecond);
    }
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}

}  // namespace
}  // namespace nplc::bench

int main(int argc, char** argv) {
    return nplc::bench::guarded("bench_motor", nplc::bench::run_all, argc, argv);
}
