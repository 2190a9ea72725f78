#include "sim/fmu/fmi3.h"

#include <fmt/format.h>

#include <vector>

#include "handle.h"

namespace {

using namespace nplc::sim::fmu;

fmi3Status status_of(Outcome outcome) {
    switch (outcome) {
        case Outcome::done:
            return fmi3OK;
        case Outcome::refused:
            return fmi3Error;
        case Outcome::broken:
            break;
    }
    return fmi3Fatal;
}

template <class Work>
fmi3Status with(fmi3Instance instance, Work work) {
    return status_of(guarded(instance, std::move(work)));
}

bool counts_match(const Instance& instance, std::size_t references, std::size_t values) {
    if (references == values) return true;
    return instance.refuse(
        fmt::format("{} value references and {} values; no variable here is an array", references, values));
}

template <class Value>
fmi3Status get_values(fmi3Instance instance, const fmi3ValueReference references[], std::size_t count,
                      Value values[], std::size_t value_count, Kind kind) {
    return with(instance, [&](Instance& one) {
        if (!counts_match(one, count, value_count) || !are_there(one, count, references, values))
            return false;
        std::vector<double> numbers(count);
        if (!one.get(references, count, kind, numbers.data())) return false;
        for (std::size_t i = 0; i < count; ++i) values[i] = static_cast<Value>(numbers[i]);
        return true;
    });
}

template <class Value>
fmi3Status set_values(fmi3Instance instance, const fmi3ValueReference references[], std::size_t count,
                      const Value values[], std::size_t value_count, Kind kind) {
    return with(instance, [&](Instance& one) {
        if (!counts_match(one, count, value_count) || !are_there(one, count, references, values))
            return false;
        const std::vector<double> numbers(values, values + count);
        return one.set(references, count, kind, numbers.data());
    });
}

fmi3Status no_variables(fmi3Instance instance, std::size_t count, std::string_view type) {
    return with(instance, [&](Instance& one) {
        return count == 0 || one.refuse(fmt::format("there are no variables of type {}", type));
    });
}

fmi3Instance no_instance(fmi3LogMessageCallback log, fmi3InstanceEnvironment environment,
                         const char* message) {
    if (log != nullptr) log(environment, fmi3Error, kErrors.data(), message);
    return nullptr;
}

}  // namespace

const char* fmi3GetVersion() {
    return "3.0";
}

fmi3Status fmi3SetDebugLogging(fmi3Instance instance, fmi3Boolean on, std::size_t count,
                               const fmi3String categories[]) {
    return with(instance, [&](Instance& one) {
        return are_there(one, count, categories, categories) && one.set_logging(on, count, categories);
    });
}

fmi3Instance fmi3InstantiateModelExchange(fmi3String, fmi3String, fmi3String, fmi3Boolean, fmi3Boolean,
                                          fmi3InstanceEnvironment environment, fmi3LogMessageCallback log) {
    return no_instance(log, environment, "this FMU is for co-simulation, not for model exchange");
}

fmi3Instance fmi3InstantiateCoSimulation(fmi3String, fmi3String token, fmi3String resources, fmi3Boolean,
                                         fmi3Boolean, fmi3Boolean, fmi3Boolean, const fmi3ValueReference[],
                                         std::size_t, fmi3InstanceEnvironment environment,
                                         fmi3LogMessageCallback log, fmi3IntermediateUpdateCallback) {
    try {
        const auto report = [environment, log](const std::string& message) {
            if (log != nullptr) log(environment, fmi3Error, kErrors.data(), message.c_str());
        };
        return enlist(Instance::make(token, resources == nullptr ? "" : resources, report));
    } catch (const std::exception& error) {
        return no_instance(log, environment, error.what());
    }
}

fmi3Instance fmi3InstantiateScheduledExecution(fmi3String, fmi3String, fmi3String, fmi3Boolean, fmi3Boolean,
                                               fmi3InstanceEnvironment environment,
                                               fmi3LogMessageCallback log, fmi3ClockUpdateCallback,
                                               fmi3LockPreemptionCallback, fmi3UnlockPreemptionCallback) {
    return no_instance(log, environment, "this FMU is for co-simulation, not for scheduled execution");
}

void fmi3FreeInstance(fmi3Instance instance) {
    discharge(instance);
}

fmi3Status fmi3EnterInitializationMode(fmi3Instance instance, fmi3Boolean, fmi3Float64, fmi3Float64 start,
                                       fmi3Boolean stop_defined, fmi3Float64 stop) {
    return with(instance, [&](Instance& one) {
        return one.set_experiment(start, stop_defined ? std::optional(stop) : std::nullopt) &&
               one.enter_initialization();
    });
}

fmi3Status fmi3ExitInitializationMode(fmi3Instance instance) {
    return with(instance, [](Instance& one) { return one.exit_initialization(); });
}

fmi3Status fmi3Terminate(fmi3Instance instance) {
    return with(instance, [](Instance& one) { return one.terminate(); });
}

fmi3Status fmi3Reset(fmi3Instance instance) {
    return with(instance, [](Instance& one) { return one.reset(); });
}

#define NPLC_FMI3_OF_KIND(Type, kind)                                                                 \
    fmi3Status fmi3Get##Type(fmi3Instance instance, const fmi3ValueReference references[],            \
                             std::size_t count, fmi3##Type values[], std::size_t value_count) {       \
        return get_values(instance, references, count, values, value_count, kind);                    \
    }                                                                                                 \
    fmi3Status fmi3Set##Type(fmi3Instance instance, const fmi3ValueReference references[],            \
                             std::size_t count, const fmi3##Type values[], std::size_t value_count) { \
        return set_values(instance, references, count, values, value_count, kind);                    \
    }
NPLC_FMI3_OF_KIND(Float64, Kind::real)
NPLC_FMI3_OF_KIND(Int32, Kind::integer)
NPLC_FMI3_OF_KIND(UInt32, Kind::bits)
NPLC_FMI3_OF_KIND(Boolean, Kind::truth)

#define NPLC_FMI3_WITHOUT(Type)                                                                    \
    fmi3Status fmi3Get##Type(fmi3Instance instance, const fmi3ValueReference[], std::size_t count, \
                             fmi3##Type[], std::size_t) {                                          \
        return no_variables(instance, count, #Type);                                               \
    }                                                                                              \
    fmi3Status fmi3Set##Type(fmi3Instance instance, const fmi3ValueReference[], std::size_t count, \
                             const fmi3##Type[], std::size_t) {                                    \
        return no_variables(instance, count, #Type);                                               \
    }
NPLC_FMI3_WITHOUT(Float32)
NPLC_FMI3_WITHOUT(Int8)
NPLC_FMI3_WITHOUT(UInt8)
NPLC_FMI3_WITHOUT(Int16)
NPLC_FMI3_WITHOUT(UInt16)
NPLC_FMI3_WITHOUT(Int64)
NPLC_FMI3_WITHOUT(UInt64)
NPLC_FMI3_WITHOUT(String)

fmi3Status fmi3GetBinary(fmi3Instance instance, const fmi3ValueReference[], std::size_t count, std::size_t[],
                         fmi3Binary[], std::size_t) {
    return no_variables(instance, count, "Binary");
}

fmi3Status fmi3SetBinary(fmi3Instance instance, const fmi3ValueReference[], std::size_t count,
                         const std::size_t[], const fmi3Binary[], std::size_t) {
    return no_variables(instance, count, "Binary");
}

fmi3Status fmi3GetClock(fmi3Instance instance, const fmi3ValueReference[], std::size_t count, fmi3Clock[]) {
    return no_variables(instance, count, "Clock");
}

fmi3Status fmi3SetClock(fmi3Instance instance, const fmi3ValueReference[], std::size_t count,
                        const fmi3Clock[]) {
    return no_variables(instance, count, "Clock");
}

fmi3Status fmi3GetFMUState(fmi3Instance instance, fmi3FMUState* state) {
    return with(instance, [&](Instance& one) { return one.save_into(state); });
}

fmi3Status fmi3SetFMUState(fmi3Instance instance, fmi3FMUState state) {
    return with(instance, [&](Instance& one) { return one.restore(static_cast<Instance::State*>(state)); });
}

fmi3Status fmi3FreeFMUState(fmi3Instance instance, fmi3FMUState* state) {
    return with(instance, [&](Instance& one) { return one.forget_at(state); });
}

fmi3Status fmi3DoStep(fmi3Instance instance, fmi3Float64 now, fmi3Float64 step, fmi3Boolean,
                      fmi3Boolean* event_handling_needed, fmi3Boolean* terminate, fmi3Boolean* early_return,
                      fmi3Float64* last_successful) {
    return with(instance, [&](Instance& one) {
        const bool done = one.step(now, step);
        for (fmi3Boolean* answer : {event_handling_needed, terminate, early_return})
            if (answer != nullptr) *answer = false;
        if (last_successful != nullptr) *last_successful = one.time();
        return done;
    });
}
