#pragma once

#include <cstddef>
#include <cstdint>

#include "sim/fmu/fmi_export.h"

/// The C interface of FMI 3.0.1 (fmi-standard.org), sections 2.2 to 4.2, as an FMU exports it.
extern "C" {

using fmi3Instance = void*;
using fmi3InstanceEnvironment = void*;
using fmi3FMUState = void*;
using fmi3ValueReference = std::uint32_t;
using fmi3Float32 = float;
using fmi3Float64 = double;
using fmi3Int8 = std::int8_t;
using fmi3UInt8 = std::uint8_t;
using fmi3Int16 = std::int16_t;
using fmi3UInt16 = std::uint16_t;
using fmi3Int32 = std::int32_t;
using fmi3UInt32 = std::uint32_t;
using fmi3Int64 = std::int64_t;
using fmi3UInt64 = std::uint64_t;
using fmi3Boolean = bool;
using fmi3Clock = bool;
using fmi3String = const char*;
using fmi3Byte = std::uint8_t;
using fmi3Binary = const fmi3Byte*;

enum fmi3Status { fmi3OK, fmi3Warning, fmi3Discard, fmi3Error, fmi3Fatal };
enum fmi3DependencyKind {
    fmi3Independent,
    fmi3Constant,
    fmi3Fixed,
    fmi3Tunable,
    fmi3Discrete,
    fmi3Dependent
};
enum fmi3IntervalQualifier { fmi3IntervalNotYetKnown, fmi3IntervalUnchanged, fmi3IntervalChanged };

using fmi3LogMessageCallback = void (*)(fmi3InstanceEnvironment, fmi3Status, fmi3String category,
                                        fmi3String message);
using fmi3ClockUpdateCallback = void (*)(fmi3InstanceEnvironment);
using fmi3IntermediateUpdateCallback = void (*)(fmi3InstanceEnvironment, fmi3Float64 time,
                                                fmi3Boolean set_requested, fmi3Boolean get_allowed,
                                                fmi3Boolean step_finished, fmi3Boolean can_return_early,
                                                fmi3Boolean* early_return_requested,
                                                fmi3Float64* early_return_time);
using fmi3LockPreemptionCallback = void (*)();
using fmi3UnlockPreemptionCallback = void (*)();

NPLC_FMI_EXPORT const char* fmi3GetVersion();
NPLC_FMI_EXPORT fmi3Status fmi3SetDebugLogging(fmi3Instance instance, fmi3Boolean on, std::size_t count,
                                               const fmi3String categories[]);

NPLC_FMI_EXPORT fmi3Instance fmi3InstantiateModelExchange(fmi3String name, fmi3String token,
                                                          fmi3String resources, fmi3Boolean visible,
                                                          fmi3Boolean logging,
                                                          fmi3InstanceEnvironment environment,
                                                          fmi3LogMessageCallback log);
NPLC_FMI_EXPORT fmi3Instance fmi3InstantiateCoSimulation(
    fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible, fmi3Boolean logging,
    fmi3Boolean event_mode_used, fmi3Boolean early_return_allowed,
    const fmi3ValueReference intermediate_variables[], std::size_t intermediate_count,
    fmi3InstanceEnvironment environment, fmi3LogMessageCallback log, fmi3IntermediateUpdateCallback update);
NPLC_FMI_EXPORT fmi3Instance fmi3InstantiateScheduledExecution(
    fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible, fmi3Boolean logging,
    fmi3InstanceEnvironment environment, fmi3LogMessageCallback log, fmi3ClockUpdateCallback update,
    fmi3LockPreemptionCallback lock, fmi3UnlockPreemptionCallback unlock);
NPLC_FMI_EXPORT void fmi3FreeInstance(fmi3Instance instance);

NPLC_FMI_EXPORT fmi3Status fmi3EnterInitializationMode(fmi3Instance instance, fmi3Boolean tolerance_defined,
                                                       fmi3Float64 tolerance, fmi3Float64 start,
                                                       fmi3Boolean stop_defined, fmi3Float64 stop);
NPLC_FMI_EXPORT fmi3Status fmi3ExitInitializationMode(fmi3Instance instance);
NPLC_FMI_EXPORT fmi3Status fmi3EnterEventMode(fmi3Instance instance);
NPLC_FMI_EXPORT fmi3Status fmi3Terminate(fmi3Instance instance);
NPLC_FMI_EXPORT fmi3Status fmi3Reset(fmi3Instance instance);

#define NPLC_FMI3_VALUES(Type)                                                                             \
    NPLC_FMI_EXPORT fmi3Status fmi3Get##Type(fmi3Instance instance, const fmi3ValueReference references[], \
                                             std::size_t count, fmi3##Type values[],                       \
                                             std::size_t value_count);                                     \
    NPLC_FMI_EXPORT fmi3Status fmi3Set##Type(fmi3Instance instance, const fmi3ValueReference references[], \
                                             std::size_t count, const fmi3##Type values[],                 \
                                             std::size_t value_count);
NPLC_FMI3_VALUES(Float32)
NPLC_FMI3_VALUES(Float64)
NPLC_FMI3_VALUES(Int8)
NPLC_FMI3_VALUES(UInt8)
NPLC_FMI3_VALUES(Int16)
NPLC_FMI3_VALUES(UInt16)
NPLC_FMI3_VALUES(Int32)
NPLC_FMI3_VALUES(UInt32)
NPLC_FMI3_VALUES(Int64)
NPLC_FMI3_VALUES(UInt64)
NPLC_FMI3_VALUES(Boolean)
NPLC_FMI3_VALUES(String)
#undef NPLC_FMI3_VALUES
NPLC_FMI_EXPORT fmi3Status fmi3GetBinary(fmi3Instance instance, const fmi3ValueReference references[],
                                         std::size_t count, std::size_t sizes[], fmi3Binary values[],
                                         std::size_t value_count);
NPLC_FMI_EXPORT fmi3Status fmi3SetBinary(fmi3Instance instance, const fmi3ValueReference references[],
                                         std::size_t count, const std::size_t sizes[],
                                         const fmi3Binary values[], std::size_t value_count);
NPLC_FMI_EXPORT fmi3Status fmi3GetClock(fmi3Instance instance, const fmi3ValueReference references[],
                                        std::size_t count, fmi3Clock values[]);
NPLC_FMI_EXPORT fmi3Status fmi3SetClock(fmi3Instance instance, const fmi3ValueReference references[],
                                        std::size_t count, const fmi3Clock values[]);

NPLC_FMI_EXPORT fmi3Status fmi3GetNumberOfVariableDependencies(fmi3Instance instance,
                                                               fmi3ValueReference reference,
                                                               std::size_t* count);
NPLC_FMI_EXPORT fmi3Status fmi3GetVariableDependencies(fmi3Instance instance, fmi3ValueReference dependent,
                                                       std::size_t dependent_elements[],
                                                       fmi3ValueReference independents[],
                                                       std::size_t independent_elements[],
                                                       fmi3DependencyKind kinds[], std::size_t count);

NPLC_FMI_EXPORT fmi3Status fmi3GetFMUState(fmi3Instance instance, fmi3FMUState* state);
NPLC_FMI_EXPORT fmi3Status fmi3SetFMUState(fmi3Instance instance, fmi3FMUState state);
NPLC_FMI_EXPORT fmi3Status fmi3FreeFMUState(fmi3Instance instance, fmi3FMUState* state);
NPLC_FMI_EXPORT fmi3Status fmi3SerializedFMUStateSize(fmi3Instance instance, fmi3FMUState state,
                                                      std::size_t* size);
NPLC_FMI_EXPORT fmi3Status fmi3SerializeFMUState(fmi3Instance instance, fmi3FMUState state, fmi3Byte bytes[],
                                                 std::size_t size);
NPLC_FMI_EXPORT fmi3Status fmi3DeserializeFMUState(fmi3Instance instance, const fmi3Byte bytes[],
                                                   std::size_t size, fmi3FMUState* state);

NPLC_FMI_EXPORT fmi3Status fmi3GetDirectionalDerivative(
    fmi3Instance instance, const fmi3ValueReference unknowns[], std::size_t unknown_count,
    const fmi3ValueReference knowns[], std::size_t known_count, const fmi3Float64 seed[],
    std::size_t seed_count, fmi3Float64 sensitivity[], std::size_t sensitivity_count);
NPLC_FMI_EXPORT fmi3Status fmi3GetAdjointDerivative(
    fmi3Instance instance, const fmi3ValueReference unknowns[], std::size_t unknown_count,
    const fmi3ValueReference knowns[], std::size_t known_count, const fmi3Float64 seed[],
    std::size_t seed_count, fmi3Float64 sensitivity[], std::size_t sensitivity_count);

NPLC_FMI_EXPORT fmi3Status fmi3EnterConfigurationMode(fmi3Instance instance);
NPLC_FMI_EXPORT fmi3Status fmi3ExitConfigurationMode(fmi3Instance instance);

NPLC_FMI_EXPORT fmi3Status fmi3GetIntervalDecimal(fmi3Instance instance,
                                                  const fmi3ValueReference references[], std::size_t count,
                                                  fmi3Float64 intervals[],
                                                  fmi3IntervalQualifier qualifiers[]);
NPLC_FMI_EXPORT fmi3Status fmi3GetIntervalFraction(fmi3Instance instance,
                                                   const fmi3ValueReference references[], std::size_t count,
                                                   fmi3UInt64 counters[], fmi3UInt64 resolutions[],
                                                   fmi3IntervalQualifier qualifiers[]);
NPLC_FMI_EXPORT fmi3Status fmi3GetShiftDecimal(fmi3Instance instance, const fmi3ValueReference references[],
                                               std::size_t count, fmi3Float64 shifts[]);
NPLC_FMI_EXPORT fmi3Status fmi3GetShiftFraction(fmi3Instance instance, const fmi3ValueReference references[],
                                                std::size_t count, fmi3UInt64 counters[],
                                                fmi3UInt64 resolutions[]);
NPLC_FMI_EXPORT fmi3Status fmi3SetIntervalDecimal(fmi3Instance instance,
                                                  const fmi3ValueReference references[], std::size_t count,
                                                  const fmi3Float64 intervals[]);
NPLC_FMI_EXPORT fmi3Status fmi3SetIntervalFraction(fmi3Instance instance,
                                                   const fmi3ValueReference references[], std::size_t count,
                                                   const fmi3UInt64 counters[],
                                                   const fmi3UInt64 resolutions[]);
NPLC_FMI_EXPORT fmi3Status fmi3SetShiftDecimal(fmi3Instance instance, const fmi3ValueReference references[],
                                               std::size_t count, const fmi3Float64 shifts[]);
NPLC_FMI_EXPORT fmi3Status fmi3SetShiftFraction(fmi3Instance instance, const fmi3ValueReference references[],
                                                std::size_t count, const fmi3UInt64 counters[],
                                                const fmi3UInt64 resolutions[]);

NPLC_FMI_EXPORT fmi3Status fmi3EvaluateDiscreteStates(fmi3Instance instance);
NPLC_FMI_EXPORT fmi3Status fmi3UpdateDiscreteStates(fmi3Instance instance, fmi3Boolean* again,
                                                    fmi3Boolean* terminate, fmi3Boolean* nominals_changed,
                                                    fmi3Boolean* values_changed,
                                                    fmi3Boolean* next_event_defined, fmi3Float64* next_event);
NPLC_FMI_EXPORT fmi3Status fmi3EnterContinuousTimeMode(fmi3Instance instance);
NPLC_FMI_EXPORT fmi3Status fmi3CompletedIntegratorStep(fmi3Instance instance, fmi3Boolean no_set_state,
                                                       fmi3Boolean* enter_event_mode, fmi3Boolean* terminate);
NPLC_FMI_EXPORT fmi3Status fmi3SetTime(fmi3Instance instance, fmi3Float64 time);
NPLC_FMI_EXPORT fmi3Status fmi3SetContinuousStates(fmi3Instance instance, const fmi3Float64 states[],
                                                   std::size_t count);
NPLC_FMI_EXPORT fmi3Status fmi3GetContinuousStateDerivatives(fmi3Instance instance, fmi3Float64 derivatives[],
                                                             std::size_t count);
NPLC_FMI_EXPORT fmi3Status fmi3GetEventIndicators(fmi3Instance instance, fmi3Float64 indicators[],
                                                  std::size_t count);
NPLC_FMI_EXPORT fmi3Status fmi3GetContinuousStates(fmi3Instance instance, fmi3Float64 states[],
                                                   std::size_t count);
NPLC_FMI_EXPORT fmi3Status fmi3GetNominalsOfContinuousStates(fmi3Instance instance, fmi3Float64 nominals[],
                                                             std::size_t count);
NPLC_FMI_EXPORT fmi3Status fmi3GetNumberOfEventIndicators(fmi3Instance instance, std::size_t* count);
NPLC_FMI_EXPORT fmi3Status fmi3GetNumberOfContinuousStates(fmi3Instance instance, std::size_t* count);

NPLC_FMI_EXPORT fmi3Status fmi3EnterStepMode(fmi3Instance instance);
NPLC_FMI_EXPORT fmi3Status fmi3GetOutputDerivatives(fmi3Instance instance,
                                                    const fmi3ValueReference references[], std::size_t count,
                                                    const fmi3Int32 orders[], fmi3Float64 values[],
                                                    std::size_t value_count);
NPLC_FMI_EXPORT fmi3Status fmi3DoStep(fmi3Instance instance, fmi3Float64 now, fmi3Float64 step,
                                      fmi3Boolean no_set_state, fmi3Boolean* event_handling_needed,
                                      fmi3Boolean* terminate, fmi3Boolean* early_return,
                                      fmi3Float64* last_successful);
NPLC_FMI_EXPORT fmi3Status fmi3ActivateModelPartition(fmi3Instance instance, fmi3ValueReference clock,
                                                      fmi3Float64 time);
}
