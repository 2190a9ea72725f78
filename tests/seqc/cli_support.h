#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace nplc::seqc::test {

namespace fs = std::filesystem;

/// The program seqc, run in a folder of its own.
class Cli : public testing::Test {
  protected:
    void SetUp() override {
        std::string name = (fs::temp_directory_path() / "seqc_test_XXXXXX").string();
        folder_ = mkdtemp(name.data());
    }
    void TearDown() override { fs::remove_all(folder_); }

    int run(const std::string& arguments) const {
        const std::string command = "'" SEQC_PROGRAM "' " + arguments + " >out 2>err";
        return shell(command);
    }
    int shell(const std::string& command) const {
        return WEXITSTATUS(std::system(("cd '" + folder_.string() + "' && " + command).c_str()));
    }
    void write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name) << text;
    }
    std::string read(const std::string& name) const {
        std::stringstream text;
        text << std::ifstream(folder_ / name, std::ios::binary).rdbuf();
        return text.str();
    }
    bool exists(const std::string& name) const { return fs::exists(folder_ / name); }

    fs::path folder_;
};

}  // namespace nplc::seqc::test
