#include "orders/order.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace nplc::orders {
namespace {

constexpr std::string_view kHead = "nanoplc-order 1\nkind table\n";
constexpr std::string_view kSignature = "signature ";
constexpr std::size_t kLongestTarget = 3 * 64 + 2;

/// Parses the text line by line and reports the first invalid one.
class Lines {
  public:
    explicit Lines(std::string_view text) : left_(text) {}

    /// The rest of the line that begins with `word` and a blank.
    std::string_view next(std::string_view word) {
        if (!error_.empty()) return {};
        const std::size_t end = left_.find('\n');
        const bool is_it = end != std::string_view::npos && left_.starts_with(word) && end > word.size() &&
                           left_[word.size()] == ' ';
        if (!is_it) {
            error_ = fmt::format("has no line `{}` where it must be", word);
            return {};
        }
        const std::string_view value = left_.substr(word.size() + 1, end - word.size() - 1);
        left_.remove_prefix(end + 1);
        return value;
    }
    void require(bool is_right, std::string_view what) {
        if (error_.empty() && !is_right) error_ = fmt::format("has a line `{}` that cannot be read", what);
    }
    std::string_view left() const { return left_; }
    const std::string& error() const { return error_; }

  private:
    std::string_view left_;
    std::string error_;
};

template <class Number>
bool read_number(std::string_view text, Number lowest, Number highest, Number& out) {
    const char* const end = text.data() + text.size();
    const auto [at, error] = std::from_chars(text.data(), end, out);
    return error == std::errc{} && at == end && text.front() != '0' && out >= lowest && out <= highest;
}

}  // namespace

bool is_name(std::string_view text, std::size_t most) {
    const auto is_plain = [](char letter) {
        const auto byte = static_cast<unsigned char>(letter);
        return byte >= 0x20 && byte != 0x7F;
    };
    return !text.empty() && text.size() <= most && std::all_of(text.begin(), text.end(), is_plain) &&
           text.front() != ' ' && text.back() != ' ';
}

bool is_target(std::string_view text) {
    if (!is_name(text, kLongestTarget) || std::count(text.begin(), text.end(), '/') != 2) return false;
    return text.front() != '/' && text.back() != '/' && text.find("//") == std::string_view::npos &&
           text.find_first_of("+#") == std::string_view::npos;
}

std::string message_of(const Order& order) {
    return fmt::format("{}target {}\ncounter {}\nname {}\nsha256 {}\nbytes {}\nkey {}\n", kHead, order.target,
                       order.counter, order.name, hex(order.sha256), order.bytes, hex(order.key));
}

std::string write_order(Order order, const Seed& seed) {
    order.key = public_key_of(seed);
    std::string text = message_of(order);
    const Signature signature = sign(text, seed);
    return text + fmt::format("{}{}\n", kSignature, hex(signature));
}

OrderReading read_order(std::string_view text) {
    if (text.size() > kLongestOrder) return {.error = fmt::format("is longer than {} bytes", kLongestOrder)};
    if (!text.starts_with(kHead)) return {.error = "is no order for a table that this program knows"};
    SignedOrder result;
    Order& order = result.order;
    Lines lines(text.substr(kHead.size()));
    order.target = lines.next("target");
    lines.require(is_target(order.target), "target");
    const std::string_view counter = lines.next("counter");
    lines.require(
        !counter.empty() && read_number<std::uint64_t>(counter, 1, std::uint64_t{INT64_MAX}, order.counter),
        "counter");
    order.name = lines.next("name");
    lines.require(is_name(order.name, kLongestName), "name");
    lines.require(read_hex(lines.next("sha256"), order.sha256), "sha256");
    const std::string_view bytes = lines.next("bytes");
    lines.require(!bytes.empty() && read_number<std::uint32_t>(bytes, 1, kMostArtifactBytes, order.bytes),
                  "bytes");
    lines.require(read_hex(lines.next("key"), order.key), "key");
    result.message = text.substr(0, text.size() - lines.left().size());
    lines.require(read_hex(lines.next("signature"), result.signature), "signature");
    if (!lines.error().empty()) return {.error = lines.error()};
    if (!lines.left().empty()) return {.error = "has something behind its signature"};
    return {.order = std::move(result)};
}

}  // namespace nplc::orders
