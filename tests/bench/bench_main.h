#pragma once

#include <cstdio>
#include <exception>

namespace nplc::bench {

/// What a benchmark's main returns: an exception is printed in one line.
inline int guarded(const char* name, int (*run)(int, char**), int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s: %s\n", name, error.what());
        return 1;
    }
}

}  // namespace nplc::bench
