#include "registers_reference/reference.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

namespace nplc::registers_reference {
namespace {

std::string read(const std::string& name) {
    std::ifstream file(std::string(REGISTERS_FOLDER) + "/" + name, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

void expect_current(registers::Model model) {
    std::istringstream expected(reference(model));
    std::istringstream found(read(file_name(model)));
    std::string wanted;
    std::string line;
    for (int number = 1; std::getline(expected, wanted); ++number) {
        std::getline(found, line);
        ASSERT_EQ(line, wanted) << file_name(model) << ":" << number
                                << " is out of date: build the target registers_reference";
    }
    EXPECT_FALSE(std::getline(found, line)) << file_name(model) << " has more lines than it should";
}

TEST(Reference, OfMac50To141IsCurrent) {
    expect_current(registers::Model::mac141);
}

TEST(Reference, OfMac800IsCurrent) {
    expect_current(registers::Model::mac800);
}

TEST(Reference, SaysWhatTheManualsSay) {
    const std::string small = reference(registers::Model::mac50);
    for (const char* text : {"| 3, 4 | P_SOLL |", "| 5 | V_SOLL |", "| 1 rpm = 2.09715 |", "| 4 | IN_POS |",
                             "| 1..0 | USERINTF |", "| 2 | P_MODE |", "| 163, 164 | P_NEW |",
                             "recommended 256 .. 2560: 1 .. 10", "nominal 256"}) {
        EXPECT_NE(small.find(text), std::string::npos) << text;
    }
    const std::string large = reference(registers::Model::mac800);
    for (const char* text :
         {"| 3 | P_SOLL |", "| 1 rpm = 2.77056 |", "| 17 | U24V_ERR |", "| 206 | CHKSUM |"}) {
        EXPECT_NE(large.find(text), std::string::npos) << text;
    }
}

}  // namespace
}  // namespace nplc::registers_reference
