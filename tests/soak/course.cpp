#include "course.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

#include "random_tables.h"

namespace nplc::soak {

using namespace std::chrono_literals;
using property::Dice;

namespace {

constexpr std::array<BadLine, 6> kBadLines{{
    {.drop = 0.03, .longest_delay = 1ms},
    {.damage = 0.004, .longest_delay = 1ms},
    {.framing = 0.02, .longest_delay = 1ms},
    {.delay = 0.02, .longest_delay = 3ms},
    {.drop = 0.01, .damage = 0.002, .framing = 0.01, .delay = 0.01, .longest_delay = 3ms},
    {.drop = 0.2, .longest_delay = 1ms},
}};

Time milliseconds(unsigned count) {
    return std::chrono::milliseconds{count};
}

class Generator {
  public:
    Generator(std::uint64_t seed, Time length) : dice_(seed), length_(length) {}

    Course course() {
        add(kFirst, Kind::upload, 0);
        add(kFirst + 500ms, Kind::input, 0 | kInputOn);
        for (Time now = kFirst + 20s; now < length_; now += pause()) happen(now);
        std::stable_sort(course_.begin(), course_.end(),
                         [](const Disturbance& a, const Disturbance& b) { return a.at < b.at; });
        while (!course_.empty() && course_.back().at >= length_) course_.pop_back();
        return std::move(course_);
    }

  private:
    /// Microseconds too, so that every moment of a message is hit.
    Time pause() {
        return milliseconds(20 + dice_.below(dice_.one_in(4) ? 40'000 : 6'000)) + 1us * dice_.below(1000);
    }

    void add(Time at, Kind kind, unsigned value = 0) { course_.push_back({at, kind, value}); }

    /// Begins, and ends after `least` to `most` milliseconds.
    void for_a_while(Time at, Kind begin, unsigned value, Kind end, unsigned least, unsigned most) {
        add(at, begin, value);
        add(at + milliseconds(least + dice_.below(most - least)) + 1us * dice_.below(1000), end);
    }

    void happen(Time at) {
        const unsigned which = dice_.below(100);
        const unsigned value = dice_.below(1'000'000);
        if (which < 38) return operate(at, value);
        if (which < 60) return spoil(at, which, value);
        if (which < 90) return ask(at, which, value);
        if (which < 94) return stop_and_run(at);
        if (which < 96) return add(at, Kind::power_cut);
        upload(at, value);
    }

    /// Start is let go for a while only.
    void operate(Time at, unsigned value) {
        constexpr unsigned kStart = 0;
        constexpr unsigned kGuard = 2;
        const unsigned index = value % 4;
        if (index == kStart || index == kGuard) {
            const unsigned rest = index == kStart ? kInputOn : 0U;
            add(at, Kind::input, index | (rest ^ kInputOn));
            add(at + milliseconds(1 + dice_.below(1'500)), Kind::input, index | rest);
        } else {
            add(at, Kind::input, 1U | (value / 4 % 2 * kInputOn));
        }
    }

    void spoil(Time at, unsigned which, unsigned value) {
        if (which < 45) return for_a_while(at, Kind::cut, 0, Kind::restore, 1, 400);
        if (which < 54)
            return for_a_while(at, Kind::spoil, value % unsigned{kBadLines.size()}, Kind::clean, 200, 8'000);
        if (which < 56) return for_a_while(at, Kind::motor_off, 0, Kind::motor_on, 40, 900);
        if (which < 57) return add(at, Kind::motor_error);
        add(at, Kind::load, value % 300);
    }

    void ask(Time at, unsigned which, unsigned value) {
        constexpr std::array kKinds{Kind::read,    Kind::read,  Kind::look,
                                    Kind::refused, Kind::noise, Kind::force};
        const Kind kind = kKinds[which % kKinds.size()];
        for (unsigned i = 0; i <= value % 5; ++i) add(at + milliseconds(60 * i), kind, value + i);
    }

    void stop_and_run(Time at) { for_a_while(at, Kind::stop, 0, Kind::run, 5, 3'000); }

    /// Every second one with a power cut in its way.
    void upload(Time at, unsigned value) {
        add(at, Kind::upload, value);
        if (dice_.one_in(2))
            add(at + milliseconds(dice_.below(900)) + 1us * dice_.below(1000), Kind::power_cut);
    }

    Dice dice_;
    Time length_;
    Course course_;
};

std::string words_of(const Disturbance& what) {
    const auto on = [](bool level) { return level ? 1 : 0; };
    switch (what.kind) {
        case Kind::input:
            return fmt::format("IN{} := {}", what.value & 7U, on((what.value & kInputOn) != 0));
        case Kind::cut:
            return "line cut";
        case Kind::restore:
            return "line restored";
        case Kind::spoil: {
            const BadLine bad = bad_line(what.value);
            return fmt::format("line drop {:g} % damage {:g} % framing {:g} % delay {:g} % up to {} ms",
                               100 * bad.drop, 100 * bad.damage, 100 * bad.framing, 100 * bad.delay,
                               bad.longest_delay / 1ms);
        }
        case Kind::clean:
            return "line clean";
        case Kind::motor_off:
            return "motor power off";
        case Kind::motor_on:
            return "motor power on";
        case Kind::motor_error:
            return "motor error";
        case Kind::load:
            return fmt::format("motor load {}", what.value);
        case Kind::stop:
            return "gateway stop";
        case Kind::run:
            return "gateway run";
        case Kind::power_cut:
            return "gateway restart";
        case Kind::read:
            return "log \"a program reads a register of the motor over the user's port\"";
        case Kind::look:
            return "log \"a program reads a block of the gateway's registers\"";
        case Kind::refused:
            return "log \"a program writes to the motor\"";
        case Kind::noise:
            return "log \"noise on the user's port\"";
        case Kind::force:
            return "log \"a program forces outputs\"";
        case Kind::upload:
            return fmt::format("log \"upload of table {}, activate, run\"", what.value % 2);
    }
    return {};
}

}  // namespace

BadLine bad_line(unsigned value) {
    return kBadLines[value % kBadLines.size()];
}

bool has_words(Kind kind) {
    return kind < Kind::read;
}

Course random_course(std::uint64_t seed, Time length) {
    return Generator(seed, length).course();
}

std::string scenario_of(const Course& course, std::uint64_t seed, Time end, const std::string& remark) {
    std::string text =
        fmt::format("# {}\n# nanoplc-sim run tests/soak/soak.seq --scenario THIS\nseed {}\n", remark, seed);
    const auto in_ms = [](Time time) { return static_cast<double>(time.count()) / 1e6; };
    for (const Disturbance& what : course)
        fmt::format_to(std::back_inserter(text), "at {:.3f} ms {}\n", in_ms(what.at), words_of(what));
    return text + fmt::format("end at {:.3f} ms\n", in_ms(end));
}

}  // namespace nplc::soak
