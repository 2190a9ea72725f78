#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <sstream>
#include <string>
#include <type_traits>

/// As much of GoogleTest as the core's tests use, for a microcontroller without exceptions and run-time type
/// information. Tests run in the order in which they are linked; a failed ASSERT leaves its function only.
namespace testing {

class Test {
  public:
    Test() = default;
    Test(const Test&) = delete;
    Test& operator=(const Test&) = delete;
    virtual ~Test() = default;
    static bool HasFailure();  ///< of the test that runs
    void run_whole_test() {
        SetUp();
        TestBody();
        TearDown();
    }

  protected:
    virtual void SetUp() {}
    virtual void TearDown() {}
    virtual void TestBody() = 0;
};

template <class T>
class TestWithParam : public Test {
  public:
    using ParamType = T;
    static const T& GetParam() { return *parameter; }
    static inline const T* parameter = nullptr;
};

template <class Fixture>
struct Parameters {
    static inline std::span<const typename Fixture::ParamType> values;
};

template <class T, class... More>
std::array<T, 1 + sizeof...(More)> Values(T first, More... more) {
    return {first, more...};
}

constexpr std::array<bool, 2> Bool() {
    return {false, true};
}

template <class Fixture>
struct Instantiated {
    explicit Instantiated(std::span<const typename Fixture::ParamType> values) {
        Parameters<Fixture>::values = values;
    }
};

/// Makes a test for its first, second ... run; nothing when there is none.
using Maker = Test* (*)(std::size_t run);

/// One test, known from before main on.
struct Registered {
    Registered(const char* suite_name, const char* test_name, Maker maker);

    const char* suite;
    const char* name;
    Maker make;
    Registered* next = nullptr;
};

template <class T>
Test* make(std::size_t run) {
    return run == 0 ? new T : nullptr;
}

template <class Fixture, class T>
Test* make_with_parameter(std::size_t run) {
    const auto values = Parameters<Fixture>::values;
    if (run == values.size()) return nullptr;
    Fixture::parameter = &values[run];
    return new T;
}

/// A number, a character string, or nothing that could be shown.
template <class T>
std::string shown(const T& value) {
    std::ostringstream text;
    if constexpr (std::is_enum_v<T>) {
        text << static_cast<long long>(value);
    } else if constexpr (std::is_integral_v<T>) {
        text << +value;
    } else if constexpr (std::is_convertible_v<T, std::string>) {
        text << '"' << std::string(value) << '"';
    } else {
        text << "an object of " << sizeof(T) << " bytes";
    }
    return text.str();
}

/// Counts a check, and keeps what was compared if it failed.
class Check {
  public:
    explicit Check(bool holds);
    template <class A, class B>
    Check(bool holds, const A& a, const B& b) : Check(holds) {
        if (!holds) values_ = shown(a) + " and " + shown(b);
    }
    bool holds() const { return holds_; }
    const std::string& values() const { return values_; }

  private:
    bool holds_;
    std::string values_;
};

template <class A, class B>
Check equal(const A& a, const B& b) {
    return Check(a == b, a, b);
}
template <class A, class B>
Check not_equal(const A& a, const B& b) {
    return Check(a != b, a, b);
}
template <class A, class B>
Check less(const A& a, const B& b) {
    return Check(a < b, a, b);
}
template <class A, class B>
Check less_or_equal(const A& a, const B& b) {
    return Check(a <= b, a, b);
}

template <class A, class B, class C>
Check near(const A& a, const B& b, const C& most) {
    return Check(a < b ? b - a <= most : a - b <= most, a, b);
}

/// Stands in the messages of failures while it lives.
class ScopedTrace {
  public:
    explicit ScopedTrace(std::string text);
    ScopedTrace(const ScopedTrace&) = delete;
    ScopedTrace& operator=(const ScopedTrace&) = delete;
    ~ScopedTrace();

  private:
    std::string before_;
};

/// What failed, with what the test adds to it.
class Message {
  public:
    Message(const char* file, int line, const char* condition, const Check& check);
    Message(const Message&) = delete;
    Message& operator=(const Message&) = delete;
    ~Message();
    template <class T>
    Message& operator<<(const T& value) {
        text_ << value;
        return *this;
    }

  private:
    std::ostringstream text_;
};

/// Makes a message the value of a return statement.
struct Nothing {
    void operator=(const Message&) const {}
};

}  // namespace testing

#define NPLC_CHECK_(check, condition, leave)                               \
    switch (0)                                                             \
    case 0:                                                                \
    default:                                                               \
        if (const ::testing::Check nplc_check = check; nplc_check.holds()) \
            ;                                                              \
        else                                                               \
            leave ::testing::Message(__FILE__, __LINE__, condition, nplc_check)
#define NPLC_LEAVE_ return ::testing::Nothing() =

#define EXPECT_TRUE(a) NPLC_CHECK_(::testing::Check(static_cast<bool>(a)), #a, )
#define EXPECT_FALSE(a) NPLC_CHECK_(::testing::Check(!static_cast<bool>(a)), "not " #a, )
#define EXPECT_EQ(a, b) NPLC_CHECK_(::testing::equal(a, b), #a " == " #b, )
#define EXPECT_NE(a, b) NPLC_CHECK_(::testing::not_equal(a, b), #a " != " #b, )
#define EXPECT_LT(a, b) NPLC_CHECK_(::testing::less(a, b), #a " < " #b, )
#define EXPECT_LE(a, b) NPLC_CHECK_(::testing::less_or_equal(a, b), #a " <= " #b, )
#define EXPECT_GT(a, b) NPLC_CHECK_(::testing::less(b, a), #a " > " #b, )
#define EXPECT_GE(a, b) NPLC_CHECK_(::testing::less_or_equal(b, a), #a " >= " #b, )
#define EXPECT_NEAR(a, b, most) NPLC_CHECK_(::testing::near(a, b, most), #a " near " #b, )
#define SCOPED_TRACE(text) const ::testing::ScopedTrace nplc_trace(text)
#define ASSERT_TRUE(a) NPLC_CHECK_(::testing::Check(static_cast<bool>(a)), #a, NPLC_LEAVE_)
#define ASSERT_FALSE(a) NPLC_CHECK_(::testing::Check(!static_cast<bool>(a)), "not " #a, NPLC_LEAVE_)
#define ASSERT_EQ(a, b) NPLC_CHECK_(::testing::equal(a, b), #a " == " #b, NPLC_LEAVE_)
#define ASSERT_NE(a, b) NPLC_CHECK_(::testing::not_equal(a, b), #a " != " #b, NPLC_LEAVE_)
#define ASSERT_GT(a, b) NPLC_CHECK_(::testing::less(b, a), #a " > " #b, NPLC_LEAVE_)
#define ASSERT_GE(a, b) NPLC_CHECK_(::testing::less_or_equal(b, a), #a " >= " #b, NPLC_LEAVE_)

#define NPLC_TEST_(fixture, suite, name, make)                               \
    class suite##_##name##_Test final : public fixture {                     \
        void TestBody() override;                                            \
    };                                                                       \
    static ::testing::Registered nplc_##suite##_##name(#suite, #name, make); \
    void suite##_##name##_Test::TestBody()
#define TEST(suite, name) NPLC_TEST_(::testing::Test, suite, name, ::testing::make<suite##_##name##_Test>)
#define TEST_F(fixture, name) NPLC_TEST_(fixture, fixture, name, ::testing::make<fixture##_##name##_Test>)
#define TEST_P(fixture, name) \
    NPLC_TEST_(fixture, fixture, name, (::testing::make_with_parameter<fixture, fixture##_##name##_Test>))
/// What would name the values is not looked at.
#define INSTANTIATE_TEST_SUITE_P(prefix, fixture, values, ...)   \
    static const auto nplc_values_##prefix##_##fixture = values; \
    static const ::testing::Instantiated<fixture> nplc_##prefix##_##fixture(nplc_values_##prefix##_##fixture)
