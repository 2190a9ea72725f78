// The report of an axis.
#include <fmt/format.h>

#include <algorithm>

#include "active_table.h"
#include "deployment/deployment.h"
#include "faces/program_version.h"
#include "ledger.h"

namespace nplc::deployment {

namespace gw = registers::gateway;

namespace {

std::string hash_of_settings(const faces::AxisImage& image) {
    std::string text;
    for (const gw::SettingInfo& info : gw::all_settings())
        text += fmt::format("{}={}\n", info.name, image.setting(info.id));
    return orders::hex(orders::sha256(text));
}

std::string hash_of_set_points(const faces::AxisImage& image) {
    const std::size_t count = image[gw::SET_POINT_COUNT] & 0xFF;
    if (count == 0) return {};
    std::string text = fmt::format("{:08x}\n", image[gw::SET_POINT_RECORD]);
    for (std::size_t i = 0; i < count; ++i) text += fmt::format("{}\n", faces::set_point_wanted(image, i));
    return orders::hex(orders::sha256(text));
}

std::string proof_in(std::span<const std::uint8_t> table) {
    if (table.size() <= gw::kProofBytes) return {};
    const auto end = table.last(gw::kProofBytes);
    if (!std::equal(gw::kProofMark.begin(), gw::kProofMark.end(), end.begin())) return {};
    return orders::hex(end.subspan(gw::kProofMark.size()));
}

}  // namespace

std::optional<orders::Report> Deployment::report() const {
    if (!active_->is_known() || stage_ == Stage::starting) return std::nullopt;
    const Record& record = ledger_->record();
    const faces::AxisImage& image = active_->image();
    const faces::AxisTable* table = active_->table();
    orders::Report report{.target = target_, .firmware = faces::program_version()};
    report.run_state = gw::name_of(image.run_state());
    report.table_sha256 = active_->sha256();
    report.table_crc = table->crc;
    report.table_bytes = static_cast<std::uint32_t>(table->uploaded.size());
    report.proof = proof_in(table->uploaded);
    if (record.runs_sha256 == active_->sha256()) {
        report.table_name = record.runs_name;
        report.running = record.runs_since;
    }
    report.set_points_sha256 = hash_of_set_points(image);
    report.recipe = faces::active_recipe(image);
    report.settings_sha256 = hash_of_settings(image);
    report.state = stage_ == Stage::waiting ? State::waiting : record.state;
    report.counter = record.counter;
    if (!record.order.empty()) report.order_sha256 = orders::hex(orders::sha256(record.order));
    report.text = !ledger_->damage().empty()  ? ledger_->damage()
                  : !ledger_->error().empty() ? ledger_->error()
                                              : record.text;
    if (!waits_.empty()) report.text += (report.text.empty() ? "" : "; ") + waits_;
    report.since = record.since;
    report.refusals = refusals_.count;
    report.refusal = refusals_.last;
    report.refused = refusals_.at;
    return report;
}

}  // namespace nplc::deployment
