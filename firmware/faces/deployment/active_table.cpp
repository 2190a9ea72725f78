#include "active_table.h"

#include "orders/order.h"

namespace nplc::deployment {

namespace gw = registers::gateway;

void ActiveTable::read(faces::AxisModel& axis, base::Instant now) {
    const auto table = axis.table();
    image_ = axis.image(now);
    is_known_ = image_.number != 0 && table->crc == image_[gw::TABLE_CRC] &&
                table->bytes.size() == image_[gw::TABLE_BYTES];
    if (!is_known_ || table == table_) return;
    table_ = table;
    sha256_ = table->uploaded.empty() ? std::string() : orders::hex(orders::sha256(table->uploaded));
}

}  // namespace nplc::deployment
