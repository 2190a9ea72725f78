#pragma once

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace nplc::sim {

/// An output file that is replaced atomically: written beside its path, then renamed by commit(). Anything
/// other than an ordinary file (/dev/stdout, a pipe) is written directly. Throws FileError.
class OutputFile {
  public:
    explicit OutputFile(const std::string& path);
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    /// The files that writing to `path` changes: none if it is written directly.
    static std::vector<std::filesystem::path> written_for(const std::string& path);

    void write(const std::string& text);
    void commit();
    const std::string& path() const { return path_; }

  private:
    std::string path_;
    std::filesystem::path target_;
    std::filesystem::path temporary_;  ///< empty when written directly
    std::ofstream stream_;
};

struct FileError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

}  // namespace nplc::sim
