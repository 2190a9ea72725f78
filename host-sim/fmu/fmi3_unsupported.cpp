#include "handle.h"
#include "sim/fmu/fmi3.h"

/// Functions that importers may look up in every FMU 3.0 and that this one does not support.
namespace {

fmi3Status not_offered(fmi3Instance instance, std::string_view function) {
    using namespace nplc::sim::fmu;
    const Outcome outcome =
        guarded(instance, [&](Instance& one) { return one.refuse_unsupported(function); });
    return outcome == Outcome::broken ? fmi3Fatal : fmi3Error;
}

}  // namespace

#define NPLC_NOT_OFFERED(name, ...)                                     \
    fmi3Status name(fmi3Instance instance __VA_OPT__(, ) __VA_ARGS__) { \
        return not_offered(instance, #name);                            \
    }

using References = const fmi3ValueReference[];

NPLC_NOT_OFFERED(fmi3EnterEventMode)
NPLC_NOT_OFFERED(fmi3GetNumberOfVariableDependencies, fmi3ValueReference, std::size_t*)
NPLC_NOT_OFFERED(fmi3GetVariableDependencies, fmi3ValueReference, std::size_t[], fmi3ValueReference[],
                 std::size_t[], fmi3DependencyKind[], std::size_t)
NPLC_NOT_OFFERED(fmi3SerializedFMUStateSize, fmi3FMUState, std::size_t*)
NPLC_NOT_OFFERED(fmi3SerializeFMUState, fmi3FMUState, fmi3Byte[], std::size_t)
NPLC_NOT_OFFERED(fmi3DeserializeFMUState, const fmi3Byte[], std::size_t, fmi3FMUState*)
NPLC_NOT_OFFERED(fmi3GetDirectionalDerivative, References, std::size_t, References, std::size_t,
                 const fmi3Float64[], std::size_t, fmi3Float64[], std::size_t)
NPLC_NOT_OFFERED(fmi3GetAdjointDerivative, References, std::size_t, References, std::size_t,
                 const fmi3Float64[], std::size_t, fmi3Float64[], std::size_t)
NPLC_NOT_OFFERED(fmi3EnterConfigurationMode)
NPLC_NOT_OFFERED(fmi3ExitConfigurationMode)
NPLC_NOT_OFFERED(fmi3GetIntervalDecimal, References, std::size_t, fmi3Float64[], fmi3IntervalQualifier[])
NPLC_NOT_OFFERED(fmi3GetIntervalFraction, References, std::size_t, fmi3UInt64[], fmi3UInt64[],
                 fmi3IntervalQualifier[])
NPLC_NOT_OFFERED(fmi3GetShiftDecimal, References, std::size_t, fmi3Float64[])
NPLC_NOT_OFFERED(fmi3GetShiftFraction, References, std::size_t, fmi3UInt64[], fmi3UInt64[])
NPLC_NOT_OFFERED(fmi3SetIntervalDecimal, References, std::size_t, const fmi3Float64[])
NPLC_NOT_OFFERED(fmi3SetIntervalFraction, References, std::size_t, const fmi3UInt64[], const fmi3UInt64[])
NPLC_NOT_OFFERED(fmi3SetShiftDecimal, References, std::size_t, const fmi3Float64[])
NPLC_NOT_OFFERED(fmi3SetShiftFraction, References, std::size_t, const fmi3UInt64[], const fmi3UInt64[])
NPLC_NOT_OFFERED(fmi3EvaluateDiscreteStates)
NPLC_NOT_OFFERED(fmi3UpdateDiscreteStates, fmi3Boolean*, fmi3Boolean*, fmi3Boolean*, fmi3Boolean*,
                 fmi3Boolean*, fmi3Float64*)
NPLC_NOT_OFFERED(fmi3EnterContinuousTimeMode)
NPLC_NOT_OFFERED(fmi3CompletedIntegratorStep, fmi3Boolean, fmi3Boolean*, fmi3Boolean*)
NPLC_NOT_OFFERED(fmi3SetTime, fmi3Float64)
NPLC_NOT_OFFERED(fmi3SetContinuousStates, const fmi3Float64[], std::size_t)
NPLC_NOT_OFFERED(fmi3GetContinuousStateDerivatives, fmi3Float64[], std::size_t)
NPLC_NOT_OFFERED(fmi3GetEventIndicators, fmi3Float64[], std::size_t)
NPLC_NOT_OFFERED(fmi3GetContinuousStates, fmi3Float64[], std::size_t)
NPLC_NOT_OFFERED(fmi3GetNominalsOfContinuousStates, fmi3Float64[], std::size_t)
NPLC_NOT_OFFERED(fmi3GetNumberOfEventIndicators, std::size_t*)
NPLC_NOT_OFFERED(fmi3GetNumberOfContinuousStates, std::size_t*)
NPLC_NOT_OFFERED(fmi3EnterStepMode)
NPLC_NOT_OFFERED(fmi3GetOutputDerivatives, References, std::size_t, const fmi3Int32[], fmi3Float64[],
                 std::size_t)
NPLC_NOT_OFFERED(fmi3ActivateModelPartition, fmi3ValueReference, fmi3Float64)
