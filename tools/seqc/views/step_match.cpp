#include "views/step_match.h"

#include "syntax/names.h"

namespace nplc::seqc {
namespace {

std::string_view name_in(const Symbols* names, std::uint8_t step) {
    return names != nullptr && step < names->steps.size() ? std::string_view(names->steps[step]) : "";
}

class Matching {
  public:
    Matching(const Machine& before, const Symbols* names_before, const Machine& now, const Symbols* names_now)
        : before_(before), names_before_(names_before), now_(now), names_now_(names_now) {
        pair(0, 0);
        each_open([&](std::uint8_t a, std::uint8_t b) { return same_given_name(a, b); });
        each_open([&](std::uint8_t a, std::uint8_t b) { return a == b && !both_named(a, b); });
        each_open([&](std::uint8_t a, std::uint8_t b) { return a == b && mostly_same(a, b); });
        each_open([&](std::uint8_t a, std::uint8_t b) { return both_named(a, b) && mostly_same(a, b); });
    }

    const StepMatch& match() const { return match_; }

  private:
    void pair(std::uint8_t a, std::uint8_t b) {
        match_.now_of[a] = b;
        match_.before_of[b] = a;
    }

    template <class Same>
    void each_open(Same same) {
        for (std::uint8_t a = 0; a < kStepNumbers; ++a) {
            for (std::uint8_t b = 0; b < kStepNumbers; ++b) {
                const bool open =
                    before_.used.test(a) && now_.used.test(b) && !match_.now_of[a] && !match_.before_of[b];
                if (open && same(a, b)) pair(a, b);
            }
        }
    }

    bool both_named(std::uint8_t a, std::uint8_t b) const {
        return !name_in(names_before_, a).empty() && !name_in(names_now_, b).empty();
    }
    bool same_given_name(std::uint8_t a, std::uint8_t b) const {
        return both_named(a, b) && same_name(name_in(names_before_, a), name_in(names_now_, b));
    }

    /// In at least half of the cases in which one of them does something, both do the same, as far as the
    /// steps that follow are known to be the same.
    bool mostly_same(std::uint8_t a, std::uint8_t b) const {
        std::size_t acting = 0;
        std::size_t same = 0;
        for (std::size_t c = 0; c < kCases; ++c) {
            const Outcome& x = before_.steps[a].in(c);
            const Outcome& y = now_.steps[b].in(c);
            const bool stays = x.next == a && y.next == b;
            if (stays && x.is_quiet() && y.is_quiet()) continue;
            ++acting;
            const bool same_next = stays || (x.next != a && y.next != b && may_be_same(x.next, y.next));
            if (same_next && x.timer == y.timer && x.counter == y.counter && x.orders == y.orders) ++same;
        }
        return acting == 0 ? a == b : 2 * same >= acting;
    }
    bool may_be_same(std::uint8_t a, std::uint8_t b) const {
        return match_.now_of[a] ? match_.now_of[a] == b : !match_.before_of[b];
    }

    const Machine& before_;
    const Symbols* names_before_;
    const Machine& now_;
    const Symbols* names_now_;
    StepMatch match_;
};

}  // namespace

StepMatch match_steps(const Machine& before, const Symbols* names_before, const Machine& now,
                      const Symbols* names_now) {
    return Matching(before, names_before, now, names_now).match();
}

}  // namespace nplc::seqc
