#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "diagnostics/codes.h"
#include "seqc/diagnostic.h"

namespace nplc::seqc {

/// Collects diagnostics. Beyond a bound further ones are dropped, warnings first: nobody reads them.
class Report {
  public:
    Diagnostic& add(Code code, Span span, std::string message, std::string help = {});
    Diagnostic& add(Diagnostic diagnostic);

    /// The one added last; there must be one.
    Diagnostic& last() { return diagnostics_.back(); }

    bool has_errors() const { return errors_ > 0; }
    std::size_t error_count() const { return errors_; }
    bool full() const { return diagnostics_.size() >= kMost; }
    /// Further errors would be dropped; as long as it does not hold, an error takes a warning's place.
    bool full_of_errors() const { return errors_ >= kMost; }
    /// Some were dropped, here or in a report whose diagnostics were added.
    bool has_more() const { return more_; }
    void note_more() { more_ = true; }
    bool has(std::string_view code) const;
    bool has(std::string_view code, Span span) const;
    /// Warnings of which `unwanted` holds.
    template <class Unwanted>
    void drop(const Unwanted& unwanted) {
        std::erase_if(diagnostics_,
                      [&](const Diagnostic& d) { return d.severity == Severity::warning && unwanted(d); });
    }
    /// In source order.
    std::vector<Diagnostic> take();

  private:
    static constexpr std::size_t kMost = 100;

    std::vector<Diagnostic> diagnostics_;
    Diagnostic dropped_;
    std::size_t errors_ = 0;
    bool more_ = false;
};

}  // namespace nplc::seqc
