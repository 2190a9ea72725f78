#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace nplc::seqc::test {

/// Runs the program in a folder of its own, with what it prints in `out` and `err`.
class CliTest : public testing::Test {
  protected:
    void SetUp() override {
        std::string name = (std::filesystem::temp_directory_path() / "seqc_test_XXXXXX").string();
        folder_ = mkdtemp(name.data());
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    int run(const std::string& arguments) const {
        const std::string command =
            "cd '" + folder_.string() + "' && '" SEQC_PROGRAM "' " + arguments + " >out 2>err";
        return WEXITSTATUS(std::system(command.c_str()));
    }
    void write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name) << text;
    }
    std::string read(const std::string& name) const {
        std::stringstream text;
        text << std::ifstream(folder_ / name, std::ios::binary).rdbuf();
        return text.str();
    }
    bool exists(const std::string& name) const { return std::filesystem::exists(folder_ / name); }

    std::filesystem::path folder_;
};

}  // namespace nplc::seqc::test
