#pragma once

#include <string>
#include <vector>

namespace nplc::sim::fmu {

struct ArchivedFile {
    std::string path;
    std::string content;
};

/// A ZIP file of these files, each deflated and dated 1980; the same files give the same bytes.
std::string archive(const std::vector<ArchivedFile>& files);

}  // namespace nplc::sim::fmu
