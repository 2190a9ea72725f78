#include "library.h"

#include "sim/fmu/fmu_file.h"

asm(".pushsection .rodata\n"
    ".balign 16\n"
    "nplc_fmu_library: .incbin \"" NPLC_FMU_LIBRARY
    "\"\n"
    "nplc_fmu_library_end: .byte 0\n"
    ".popsection\n");

extern "C" {
extern const char nplc_fmu_library[] __attribute__((visibility("hidden")));
extern const char nplc_fmu_library_end[] __attribute__((visibility("hidden")));
}

namespace nplc::sim::fmu {

std::string_view library() {
    return {nplc_fmu_library, static_cast<std::size_t>(nplc_fmu_library_end - nplc_fmu_library)};
}

std::string library_path(int fmi) {
    const std::string processor = NPLC_PROCESSOR;
    const std::string platform =
        fmi == 2 && processor == "x86_64" ? std::string("linux64") : processor + "-linux";
    return "binaries/" + platform + "/" + std::string(kModelIdentifier) + ".so";
}

}  // namespace nplc::sim::fmu
