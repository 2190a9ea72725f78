#include "fmu_command.h"
#include "input_file.h"

namespace nplc::sim {

void write_fmu(const FmuCommand& command) {
    throw InputError("--output " + command.output +
                     ": this nanoplc-sim was built without FMUs; use the one of the package seqc");
}

}  // namespace nplc::sim
