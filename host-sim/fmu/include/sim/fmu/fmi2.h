#pragma once

#include <cstddef>

#include "sim/fmu/fmi_export.h"

/// The C interface of FMI 2.0.4 (fmi-standard.org), sections 2.1 and 4.2, as an FMU for co-simulation exports
/// it.
extern "C" {

using fmi2Component = void*;
using fmi2ComponentEnvironment = void*;
using fmi2FMUstate = void*;
using fmi2ValueReference = unsigned int;
using fmi2Real = double;
using fmi2Integer = int;
using fmi2Boolean = int;
using fmi2String = const char*;
using fmi2Byte = char;

enum fmi2Status { fmi2OK, fmi2Warning, fmi2Discard, fmi2Error, fmi2Fatal, fmi2Pending };
enum fmi2Type { fmi2ModelExchange, fmi2CoSimulation };
enum fmi2StatusKind { fmi2DoStepStatus, fmi2PendingStatus, fmi2LastSuccessfulTime, fmi2Terminated };

struct fmi2CallbackFunctions {
    void (*logger)(fmi2ComponentEnvironment, fmi2String name, fmi2Status, fmi2String category,
                   fmi2String message, ...);
    void* (*allocateMemory)(std::size_t, std::size_t);
    void (*freeMemory)(void*);
    void (*stepFinished)(fmi2ComponentEnvironment, fmi2Status);
    fmi2ComponentEnvironment componentEnvironment;
};

NPLC_FMI_EXPORT const char* fmi2GetTypesPlatform();
NPLC_FMI_EXPORT const char* fmi2GetVersion();
NPLC_FMI_EXPORT fmi2Status fmi2SetDebugLogging(fmi2Component component, fmi2Boolean on, std::size_t count,
                                               const fmi2String categories[]);
NPLC_FMI_EXPORT fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid,
                                              fmi2String resources, const fmi2CallbackFunctions* functions,
                                              fmi2Boolean visible, fmi2Boolean logging);
NPLC_FMI_EXPORT void fmi2FreeInstance(fmi2Component component);
NPLC_FMI_EXPORT fmi2Status fmi2SetupExperiment(fmi2Component component, fmi2Boolean tolerance_defined,
                                               fmi2Real tolerance, fmi2Real start, fmi2Boolean stop_defined,
                                               fmi2Real stop);
NPLC_FMI_EXPORT fmi2Status fmi2EnterInitializationMode(fmi2Component component);
NPLC_FMI_EXPORT fmi2Status fmi2ExitInitializationMode(fmi2Component component);
NPLC_FMI_EXPORT fmi2Status fmi2Terminate(fmi2Component component);
NPLC_FMI_EXPORT fmi2Status fmi2Reset(fmi2Component component);

#define NPLC_FMI2_VALUES(Type)                                                                               \
    NPLC_FMI_EXPORT fmi2Status fmi2Get##Type(fmi2Component component, const fmi2ValueReference references[], \
                                             std::size_t count, fmi2##Type values[]);                        \
    NPLC_FMI_EXPORT fmi2Status fmi2Set##Type(fmi2Component component, const fmi2ValueReference references[], \
                                             std::size_t count, const fmi2##Type values[]);
NPLC_FMI2_VALUES(Real)
NPLC_FMI2_VALUES(Integer)
NPLC_FMI2_VALUES(Boolean)
NPLC_FMI2_VALUES(String)
#undef NPLC_FMI2_VALUES

NPLC_FMI_EXPORT fmi2Status fmi2GetFMUstate(fmi2Component component, fmi2FMUstate* state);
NPLC_FMI_EXPORT fmi2Status fmi2SetFMUstate(fmi2Component component, fmi2FMUstate state);
NPLC_FMI_EXPORT fmi2Status fmi2FreeFMUstate(fmi2Component component, fmi2FMUstate* state);
NPLC_FMI_EXPORT fmi2Status fmi2SerializedFMUstateSize(fmi2Component component, fmi2FMUstate state,
                                                      std::size_t* size);
NPLC_FMI_EXPORT fmi2Status fmi2SerializeFMUstate(fmi2Component component, fmi2FMUstate state,
                                                 fmi2Byte bytes[], std::size_t size);
NPLC_FMI_EXPORT fmi2Status fmi2DeSerializeFMUstate(fmi2Component component, const fmi2Byte bytes[],
                                                   std::size_t size, fmi2FMUstate* state);
NPLC_FMI_EXPORT fmi2Status fmi2GetDirectionalDerivative(fmi2Component component,
                                                        const fmi2ValueReference unknowns[],
                                                        std::size_t unknown_count,
                                                        const fmi2ValueReference knowns[],
                                                        std::size_t known_count, const fmi2Real seed[],
                                                        fmi2Real sensitivity[]);
NPLC_FMI_EXPORT fmi2Status fmi2SetRealInputDerivatives(fmi2Component component,
                                                       const fmi2ValueReference references[],
                                                       std::size_t count, const fmi2Integer orders[],
                                                       const fmi2Real values[]);
NPLC_FMI_EXPORT fmi2Status fmi2GetRealOutputDerivatives(fmi2Component component,
                                                        const fmi2ValueReference references[],
                                                        std::size_t count, const fmi2Integer orders[],
                                                        fmi2Real values[]);
NPLC_FMI_EXPORT fmi2Status fmi2DoStep(fmi2Component component, fmi2Real now, fmi2Real step,
                                      fmi2Boolean no_set_state);
NPLC_FMI_EXPORT fmi2Status fmi2CancelStep(fmi2Component component);
NPLC_FMI_EXPORT fmi2Status fmi2GetStatus(fmi2Component component, fmi2StatusKind kind, fmi2Status* value);
NPLC_FMI_EXPORT fmi2Status fmi2GetRealStatus(fmi2Component component, fmi2StatusKind kind, fmi2Real* value);
NPLC_FMI_EXPORT fmi2Status fmi2GetIntegerStatus(fmi2Component component, fmi2StatusKind kind,
                                                fmi2Integer* value);
NPLC_FMI_EXPORT fmi2Status fmi2GetBooleanStatus(fmi2Component component, fmi2StatusKind kind,
                                                fmi2Boolean* value);
NPLC_FMI_EXPORT fmi2Status fmi2GetStringStatus(fmi2Component component, fmi2StatusKind kind,
                                               fmi2String* value);
}
