// The operator's seat, as a listener's clients see and change it.
#include <chrono>

#include "listener/listener.h"
#include "listener/results.h"
#include "registers/gateway.h"

namespace nplc::boards {

namespace gw = registers::gateway;
namespace mactalk = protocol::mactalk;
using faces::Seat;

/// True: the message was answered or refused here.
bool Listener::is_about_operating(Client& client, const Frame& frame, base::Instant now) {
    const mactalk::Request& message = frame.message;
    if (options_.operators == nullptr || message.address != addresses_.gateway) return false;
    if (message.kind == mactalk::Kind::read) {
        if (message.reg < gw::OPERATOR || message.reg > gw::OPERATOR_LEFT) return false;
        tell(client, message.reg, shown_operator(client, message.reg, now), now);
        return true;
    }
    if (message.kind != mactalk::Kind::write || message.reg != gw::OPERATE) return false;
    client.result = operate(client, frame, now);
    if (*client.result == result_word(gw::Result::done, gw::OPERATE))
        queue(client.id, mactalk::encode_accept().view(), now);
    return true;
}

/// Returns the word for RESULT.
std::uint32_t Listener::operate(Client& client, const Frame& frame, base::Instant now) {
    if (const auto refused = refusal_for_anybody(client, frame, now)) return *refused;
    Seat& seat = *options_.operators;
    Seat::Verdict verdict = Seat::Verdict::granted;
    switch (static_cast<gw::Operating>(frame.message.value)) {
        case gw::Operating::take:
            verdict = seat.take(client.sitter, now);
            break;
        case gw::Operating::take_over:
            verdict = seat.take_over(client.sitter, now);
            break;
        case gw::Operating::give_back:
            if (seat.holder() != nullptr && !seat.give_back(client.sitter)) verdict = Seat::Verdict::taken;
            break;
        default:
            return result_word(gw::Result::bad_value, gw::OPERATE);
    }
    if (verdict == Seat::Verdict::granted) return result_word(gw::Result::done, gw::OPERATE);
    return result_word(gw::Result::seat_taken, gw::OPERATE, faces::detail_of(verdict));
}

std::uint32_t Listener::shown_operator(const Client& client, std::uint8_t reg, base::Instant now) const {
    Seat& seat = *options_.operators;
    seat.look(now);
    const faces::Sitter* const holder = seat.holder();
    if (holder == nullptr) return 0;
    if (reg == gw::OPERATOR_PEER) return holder->peer;
    if (reg == gw::OPERATOR_LEFT)
        return static_cast<std::uint32_t>(std::chrono::ceil<std::chrono::seconds>(seat.ends() - now).count());
    return static_cast<std::uint32_t>(holder->way) |
           (seat.is_holder(client.sitter) ? std::uint32_t{gw::kOperatorIsYou} : 0U) |
           (seat.was_taken_from(client.sitter) ? std::uint32_t{gw::kOperatorTookFromYou} : 0U);
}

}  // namespace nplc::boards
