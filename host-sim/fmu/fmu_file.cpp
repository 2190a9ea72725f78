#include "sim/fmu/fmu_file.h"

#include <fmt/format.h>

#include <vector>

#include "archive.h"
#include "library.h"
#include "model_description.h"
#include "sim/fmu/machine.h"

namespace nplc::sim::fmu {

std::string fmu_file(const FmuOptions& options) {
    static_cast<void>(make_machine(options.setup));  // throws if the machine is not possible
    const auto resource = [](std::string_view name) { return fmt::format("resources/{}", name); };
    std::vector<ArchivedFile> files = {
        {"modelDescription.xml", model_description(options)},
        {resource(kMachineFile), machine_text(options.setup)},
    };
    if (const auto& table = options.setup.table)
        files.push_back({resource(kTableFile), std::string(table->begin(), table->end())});
    files.push_back({library_path(options.fmi), std::string(library())});
    if (!options.windows_dll.empty()) {
        files.push_back({fmt::format("binaries/{}/{}.dll", options.fmi == 2 ? "win64" : "x86_64-windows",
                                     kModelIdentifier),
                         options.windows_dll});
    }
    return archive(files);
}

}  // namespace nplc::sim::fmu
