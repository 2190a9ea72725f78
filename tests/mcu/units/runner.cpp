// Runs the tests on the bare core and reports the results to the debugger's host.

#include <gtest/gtest.h>

#include <cstring>

#include "hal_mcu/cortex_m/start.h"
#include "semihosting.h"

namespace testing {
namespace {

Registered* first = nullptr;
Registered** end = &first;
unsigned checks = 0;
unsigned failures = 0;
unsigned failures_before_test = 0;
std::string trace;

struct Count {
    unsigned tests = 0;
    unsigned checks = 0;
    unsigned failures = 0;
};

/// Of a suite, which may be spread over files.
Count run_suite(Registered& begin) {
    Count count;
    const unsigned checks_before = checks;
    const unsigned failures_before = failures;
    for (Registered* test = &begin; test != nullptr; test = test->next) {
        if (test->make == nullptr || std::strcmp(test->suite, begin.suite) != 0) continue;
        for (std::size_t run = 0; Test* made = test->make(run); ++run) {
            failures_before_test = failures;
            made->run_whole_test();
            delete made;
            ++count.tests;
            if (Test::HasFailure())
                mcu_units::print((std::string("FAILED ") + test->suite + "." + test->name + "\n").c_str());
        }
        test->make = nullptr;
    }
    count.checks = checks - checks_before;
    count.failures = failures - failures_before;
    return count;
}

}  // namespace

Registered::Registered(const char* suite_name, const char* test_name, Maker maker)
    : suite(suite_name), name(test_name), make(maker) {
    *end = this;
    end = &next;
}

bool Test::HasFailure() {
    return failures != failures_before_test;
}

Check::Check(bool holds) : holds_(holds) {
    ++checks;
}

ScopedTrace::ScopedTrace(std::string text) : before_(trace) {
    trace += text + ": ";
}

ScopedTrace::~ScopedTrace() {
    trace = before_;
}

Message::Message(const char* file, int line, const char* condition, const Check& check) {
    text_ << trace << file << ":" << line << ": not so: " << condition;
    if (!check.values().empty()) text_ << " (" << check.values() << ")";
    text_ << " ";
}

Message::~Message() {
    ++failures;
    mcu_units::print((text_.str() + "\n").c_str());
}

}  // namespace testing

void run_firmware() {
    for (testing::Registered* test = testing::first; test != nullptr; test = test->next) {
        if (test->make == nullptr) continue;
        const testing::Count count = testing::run_suite(*test);
        std::ostringstream line;
        line << "suite " << test->suite << ": " << count.tests << " tests, " << count.checks << " checks, "
             << count.failures << " failures\n";
        mcu_units::print(line.str().c_str());
    }
    mcu_units::exit(testing::failures == 0);
}

void end_firmware(std::uint32_t exception, std::uint32_t code_address) {
    std::ostringstream line;
    line << "exception " << exception << " at " << std::hex << code_address << "h\n";
    mcu_units::print(line.str().c_str());
    mcu_units::exit(false);
}
