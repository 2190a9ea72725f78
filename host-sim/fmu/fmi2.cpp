#include "sim/fmu/fmi2.h"

#include <fmt/format.h>

#include <bit>
#include <charconv>
#include <cstdint>
#include <vector>

#include "handle.h"

namespace {

using namespace nplc::sim::fmu;

fmi2Status status_of(Outcome outcome) {
    switch (outcome) {
        case Outcome::done:
            return fmi2OK;
        case Outcome::refused:
            return fmi2Error;
        case Outcome::broken:
            break;
    }
    return fmi2Fatal;
}

template <class Work>
fmi2Status with(fmi2Component component, Work work) {
    return status_of(guarded(component, std::move(work)));
}

fmi2Status unsupported(fmi2Component component, std::string_view function) {
    return with(component, [&](Instance& one) { return one.refuse_unsupported(function); });
}

/// Path of an URI such as "file:///tmp/a%20b/resources"; other text is returned as a path.
std::string path_of(std::string_view uri) {
    if (!uri.starts_with("file:")) return std::string(uri);
    uri.remove_prefix(5);
    if (uri.starts_with("//")) {
        uri.remove_prefix(2);
        uri.remove_prefix(std::min(uri.find('/'), uri.size()));  // the host name
    }
    if (uri.size() > 2 && uri[2] == ':') uri.remove_prefix(1);  // "/C:/"
    std::string path;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        unsigned byte = 0;
        const char* digits = uri.data() + i + 1;
        if (uri[i] == '%' && i + 2 < uri.size() &&
            std::from_chars(digits, digits + 2, byte, 16).ptr == digits + 2) {
            path += static_cast<char>(byte);
            i += 2;
        } else {
            path += uri[i];
        }
    }
    return path;
}

/// FMI 2.0 has no unsigned integers: the bit pattern is kept.
Kind kind_in_2(const Instance& one, fmi2ValueReference reference, Kind kind) {
    return kind == Kind::integer && one.is_bits(reference) ? Kind::bits : kind;
}

template <class Value>
fmi2Status get_values(fmi2Component component, const fmi2ValueReference references[], std::size_t count,
                      Value values[], Kind kind) {
    return with(component, [&](Instance& one) {
        if (!are_there(one, count, references, values)) return false;
        std::vector<double> numbers(count);
        for (std::size_t i = 0; i < count; ++i) {
            if (!one.get(&references[i], 1, kind_in_2(one, references[i], kind), &numbers[i])) return false;
        }
        for (std::size_t i = 0; i < count; ++i) {
            if constexpr (std::is_same_v<Value, double>)
                values[i] = numbers[i];
            else
                values[i] = static_cast<Value>(static_cast<std::int64_t>(numbers[i]));
        }
        return true;
    });
}

template <class Value>
fmi2Status set_values(fmi2Component component, const fmi2ValueReference references[], std::size_t count,
                      const Value values[], Kind kind) {
    return with(component, [&](Instance& one) {
        if (!are_there(one, count, references, values)) return false;
        std::vector<double> numbers(values, values + count);
        if (kind == Kind::truth)
            for (double& number : numbers) number = number != 0 ? 1 : 0;
        return one.set(references, count, kind, numbers.data());
    });
}

}  // namespace

const char* fmi2GetTypesPlatform() {
    return "default";
}

const char* fmi2GetVersion() {
    return "2.0";
}

fmi2Status fmi2SetDebugLogging(fmi2Component component, fmi2Boolean on, std::size_t count,
                               const fmi2String categories[]) {
    return with(component, [&](Instance& one) {
        return are_there(one, count, categories, categories) && one.set_logging(on != 0, count, categories);
    });
}

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                              const fmi2CallbackFunctions* functions, fmi2Boolean, fmi2Boolean) {
    const auto logger = functions == nullptr ? nullptr : functions->logger;
    auto* const environment = functions == nullptr ? nullptr : functions->componentEnvironment;
    try {
        const auto report = [logger, environment,
                             who = std::string(name == nullptr ? "" : name)](const std::string& message) {
            if (logger != nullptr)
                logger(environment, who.c_str(), fmi2Error, kErrors.data(), "%s", message.c_str());
        };
        if (type != fmi2CoSimulation) {
            report("this FMU is for co-simulation, not for model exchange");
            return nullptr;
        }
        return enlist(Instance::make(guid, resources == nullptr ? "" : path_of(resources), report));
    } catch (const std::exception&) {
        return nullptr;
    }
}

void fmi2FreeInstance(fmi2Component component) {
    discharge(component);
}

fmi2Status fmi2SetupExperiment(fmi2Component component, fmi2Boolean, fmi2Real, fmi2Real start,
                               fmi2Boolean stop_defined, fmi2Real stop) {
    return with(component, [&](Instance& one) {
        return one.set_experiment(start, stop_defined != 0 ? std::optional(stop) : std::nullopt);
    });
}

fmi2Status fmi2EnterInitializationMode(fmi2Component component) {
    return with(component, [](Instance& one) { return one.enter_initialization(); });
}

fmi2Status fmi2ExitInitializationMode(fmi2Component component) {
    return with(component, [](Instance& one) { return one.exit_initialization(); });
}

fmi2Status fmi2Terminate(fmi2Component component) {
    return with(component, [](Instance& one) { return one.terminate(); });
}

fmi2Status fmi2Reset(fmi2Component component) {
    return with(component, [](Instance& one) { return one.reset(); });
}

#define NPLC_FMI2_OF_KIND(Type, kind)                                                        \
    fmi2Status fmi2Get##Type(fmi2Component component, const fmi2ValueReference references[], \
                             std::size_t count, fmi2##Type values[]) {                       \
        return get_values(component, references, count, values, kind);                       \
    }                                                                                        \
    fmi2Status fmi2Set##Type(fmi2Component component, const fmi2ValueReference references[], \
                             std::size_t count, const fmi2##Type values[]) {                 \
        return set_values(component, references, count, values, kind);                       \
    }
NPLC_FMI2_OF_KIND(Real, Kind::real)
NPLC_FMI2_OF_KIND(Integer, Kind::integer)
NPLC_FMI2_OF_KIND(Boolean, Kind::truth)

fmi2Status fmi2GetString(fmi2Component component, const fmi2ValueReference[], std::size_t count,
                         fmi2String[]) {
    return with(component, [&](Instance& one) {
        return count == 0 || one.refuse("there are no variables of type String");
    });
}

fmi2Status fmi2SetString(fmi2Component component, const fmi2ValueReference[], std::size_t count,
                         const fmi2String[]) {
    return with(component, [&](Instance& one) {
        return count == 0 || one.refuse("there are no variables of type String");
    });
}

fmi2Status fmi2GetFMUstate(fmi2Component component, fmi2FMUstate* state) {
    return with(component, [&](Instance& one) { return one.save_into(state); });
}

fmi2Status fmi2SetFMUstate(fmi2Component component, fmi2FMUstate state) {
    return with(component, [&](Instance& one) { return one.restore(static_cast<Instance::State*>(state)); });
}

fmi2Status fmi2FreeFMUstate(fmi2Component component, fmi2FMUstate* state) {
    return with(component, [&](Instance& one) { return one.forget_at(state); });
}

fmi2Status fmi2SerializedFMUstateSize(fmi2Component component, fmi2FMUstate, std::size_t*) {
    return unsupported(component, "fmi2SerializedFMUstateSize");
}

fmi2Status fmi2SerializeFMUstate(fmi2Component component, fmi2FMUstate, fmi2Byte[], std::size_t) {
    return unsupported(component, "fmi2SerializeFMUstate");
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component component, const fmi2Byte[], std::size_t, fmi2FMUstate*) {
    return unsupported(component, "fmi2DeSerializeFMUstate");
}

fmi2Status fmi2GetDirectionalDerivative(fmi2Component component, const fmi2ValueReference[], std::size_t,
                                        const fmi2ValueReference[], std::size_t, const fmi2Real[],
                                        fmi2Real[]) {
    return unsupported(component, "fmi2GetDirectionalDerivative");
}

fmi2Status fmi2SetRealInputDerivatives(fmi2Component component, const fmi2ValueReference[], std::size_t,
                                       const fmi2Integer[], const fmi2Real[]) {
    return unsupported(component, "fmi2SetRealInputDerivatives");
}

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component component, const fmi2ValueReference[], std::size_t,
                                        const fmi2Integer[], fmi2Real[]) {
    return unsupported(component, "fmi2GetRealOutputDerivatives");
}

fmi2Status fmi2DoStep(fmi2Component component, fmi2Real now, fmi2Real step, fmi2Boolean) {
    return with(component, [&](Instance& one) { return one.step(now, step); });
}

fmi2Status fmi2CancelStep(fmi2Component component) {
    return unsupported(component, "fmi2CancelStep");
}

/// No step is in progress when a call has returned.
fmi2Status fmi2GetStatus(fmi2Component component, fmi2StatusKind, fmi2Status*) {
    return unsupported(component, "fmi2GetStatus");
}

fmi2Status fmi2GetRealStatus(fmi2Component component, fmi2StatusKind kind, fmi2Real* value) {
    return with(component, [&](Instance& one) {
        if (kind != fmi2LastSuccessfulTime || value == nullptr)
            return one.refuse_unsupported("fmi2GetRealStatus");
        *value = one.time();
        return true;
    });
}

fmi2Status fmi2GetIntegerStatus(fmi2Component component, fmi2StatusKind, fmi2Integer*) {
    return unsupported(component, "fmi2GetIntegerStatus");
}

fmi2Status fmi2GetBooleanStatus(fmi2Component component, fmi2StatusKind kind, fmi2Boolean* value) {
    return with(component, [&](Instance& one) {
        if (kind != fmi2Terminated || value == nullptr) return one.refuse_unsupported("fmi2GetBooleanStatus");
        *value = 0;
        return true;
    });
}

fmi2Status fmi2GetStringStatus(fmi2Component component, fmi2StatusKind, fmi2String*) {
    return unsupported(component, "fmi2GetStringStatus");
}
