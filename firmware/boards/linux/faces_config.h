#pragma once

#include "faces/axis_loop.h"
#include "metrics/server.h"
#include "modbus/rtu_server.h"
#include "modbus/tcp_server.h"
#include "section.h"

namespace nplc::boards {

/// Table `modbus`. Without `listen` there is no TCP server, without `rtu_port` none on a serial line.
struct ModbusConfig {
    LocatedText listen;
    modbus::TcpServer::Options options{};
    LocatedText rtu_port;
    modbus::RtuServer::Options rtu{};
};
ModbusConfig read_modbus(Section& root, Findings& findings);

/// Table `metrics`. Without `listen` there is no server.
struct MetricsConfig {
    LocatedText listen;
};
MetricsConfig read_metrics(Section& root, Findings& findings);

/// Tables `control` and `scale` of an axis.
void read_control(Section& axis, faces::LoopSettings& settings, Findings& findings);
faces::Scaling read_scale(Section& axis, Findings& findings);

}  // namespace nplc::boards
