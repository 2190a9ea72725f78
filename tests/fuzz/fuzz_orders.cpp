// Any text is an order, a report, a key, a topic or what was kept of orders, and comes back byte for byte or
// value for value, or is refused.
#include <cstdint>
#include <string>
#include <string_view>

#include "deployment/settings.h"
#include "fuzz.h"
#include "orders/keys.h"
#include "orders/order.h"
#include "orders/report.h"
#include "orders/topics.h"
#include "record.h"

namespace {

using namespace nplc;

void order(std::string_view text) {
    const orders::OrderReading read = orders::read_order(text);
    require(read.order.has_value() == read.error.empty());
    if (!read.order) return;
    require(read.order->message == orders::message_of(read.order->order));
    require(text == read.order->message + "signature " + orders::hex(read.order->signature) + "\n");
    require(orders::is_target(read.order->order.target) && read.order->order.counter != 0);
}

void report(std::string_view text) {
    const auto read = orders::read_report(text);
    if (!read) return;
    const std::string written = orders::write_report(*read);
    const auto again = orders::read_report(written);
    require(again && orders::write_report(*again) == written);
}

void keys(std::string_view text) {
    if (const auto key = orders::read_public(text)) require(orders::write_public(*key) == text);
    if (const auto key = orders::read_secret(text))
        require(orders::write_secret(key->name, key->seed) == text);
}

void rest(std::string_view text) {
    if (const auto window = deployment::read_window(text)) require(window->text() == text);
    if (const auto record = deployment::read_record(text))
        require(deployment::read_record(deployment::write_record(*record)) == record);
    if (const auto target = orders::target_of(text, "order")) require(orders::order_topic(*target) == text);
    if (const auto piece = orders::read_piece_topic(text))
        require(orders::read_piece_topic(orders::piece_topic(piece->hash, piece->number))->number ==
                piece->number);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    order(text);
    report(text);
    keys(text);
    rest(text);
    return 0;
}
